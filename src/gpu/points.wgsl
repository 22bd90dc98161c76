// Points as round dots that face the viewer. Instances are `Point`s of scene.rs.

struct Dot {
    @builtin(position) position: vec4f,
    // Position from the center of the dot, physical pixels.
    @location(0) @interpolate(linear) offset_px: vec2f,
    @location(1) @interpolate(flat) color: vec4f,
    @location(2) @interpolate(flat) radius_px: f32,
}

// One triangle around the disc instead of two for a square: fewer vertices, and the pixels in the corners cost less time than
// the vertices.
const CORNERS = array(vec2f(0.0, -2.0), vec2f(1.7320508, 1.0), vec2f(-1.7320508, 1.0));

@vertex
fn vertex(
    @builtin(vertex_index) corner: u32,
    @location(0) position: vec3f,
    @location(1) color: vec4f,
    @location(2) size_px: f32,
) -> Dot {
    let clip = globals.clip_from_world * vec4f(position, 1.0);
    // A dot smaller than a pixel is drawn one pixel wide and fainter.
    let diameter_px = size_px * globals.scale;
    let radius_px = 0.5 * max(diameter_px, 1.0);
    var corners = CORNERS;
    var dot: Dot;
    dot.offset_px = corners[corner] * (radius_px + 0.5);
    dot.color = vec4f(color.rgb, color.a * clamp(diameter_px, 0.0, 1.0));
    dot.radius_px = radius_px;
    if clip.w > 0.0 && clip.z >= 0.0 {
        dot.position = clip_from_px(px_from_clip(clip) + dot.offset_px, clip.z / clip.w);
    } else {
        // A point behind the viewer gets three equal corners outside of the screen, so that nothing is drawn.
        dot.position = vec4f(2.0, 2.0, 2.0, 1.0);
    }
    return dot;
}

struct Shaded {
    @location(0) color: vec4f,
    @builtin(frag_depth) depth: f32,
}

@fragment
fn fragment(dot: Dot) -> Shaded {
    let coverage = saturate(dot.radius_px + 0.5 - length(dot.offset_px));
    if coverage <= 0.0 {
        discard;
    }
    // The outer half of the soft rim has the depth of the background, so that the rim neither covers nor hides other points.
    return Shaded(premultiplied(dot.color, coverage), select(1.0, dot.position.z, coverage >= 0.5));
}
