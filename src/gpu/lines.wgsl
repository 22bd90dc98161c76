// Lines as rectangles on the screen, with soft edges and round ends. Instances are `Segment`s of upload.rs.

// Opacity of the hidden parts of a `Faint` line, as a share of the line's own; 1 in the other pipelines.
override strength: f32 = 1.0;

struct Stroke {
    @builtin(position) position: vec4f,
    // Position along the line from the first end on the screen, and across the line, physical pixels.
    @location(0) @interpolate(linear) place_px: vec2f,
    @location(1) @interpolate(flat) color: vec4f,
    // Length on the screen, half the width, length of a dash (0: solid line), physical pixels.
    @location(2) @interpolate(flat) shape_px: vec3f,
}

// The place of the near plane between two depths of which one is negative, as a share of their distance.
fn cut(from_depth: f32, to_depth: f32) -> f32 {
    return from_depth / (from_depth - to_depth);
}

@vertex
fn vertex(
    @builtin(vertex_index) corner: u32,
    @location(0) a: vec3f,
    @location(1) b: vec3f,
    @location(2) color: vec4f,
    @location(3) width_px: f32,
    @location(4) dash_px: f32,
) -> Stroke {
    var stroke: Stroke;
    var from_clip = globals.clip_from_world * vec4f(a, 1.0);
    var to_clip = globals.clip_from_world * vec4f(b, 1.0);
    if from_clip.z < 0.0 && to_clip.z < 0.0 {
        stroke.position = vec4f(2.0, 2.0, 2.0, 1.0);
        return stroke;
    }
    if from_clip.z < 0.0 {
        from_clip = mix(from_clip, to_clip, cut(from_clip.z, to_clip.z));
    } else if to_clip.z < 0.0 {
        to_clip = mix(to_clip, from_clip, cut(to_clip.z, from_clip.z));
    }
    let from_px = px_from_clip(from_clip);
    let to_px = px_from_clip(to_clip);
    let length_px = distance(from_px, to_px);
    // A line in the direction of view is drawn as a dot.
    let along = select(vec2f(1.0, 0.0), (to_px - from_px) / length_px, length_px > 1e-4);
    let across = vec2f(-along.y, along.x);

    let width = max(width_px * globals.scale, 1.0);
    let reach = 0.5 * width + 0.5;
    let at_end = corner >= 2u;
    let side = select(-1.0, 1.0, corner % 2u == 1u);
    stroke.place_px = vec2f(select(-reach, length_px + reach, at_end), side * reach);
    let at_px = from_px + along * stroke.place_px.x + across * stroke.place_px.y;
    let from_depth = from_clip.z / from_clip.w;
    let to_depth = to_clip.z / to_clip.w;
    stroke.position = clip_from_px(at_px, select(from_depth, to_depth, at_end));
    // A line thinner than a pixel is drawn one pixel wide and fainter.
    stroke.color = vec4f(color.rgb, color.a * clamp(width_px * globals.scale, 0.0, 1.0) * strength);
    stroke.shape_px = vec3f(length_px, 0.5 * width, dash_px * globals.scale);
    return stroke;
}

@fragment
fn fragment(stroke: Stroke) -> @location(0) vec4f {
    let half_width = stroke.shape_px.y;
    let dash = stroke.shape_px.z;
    var dash_start = 0.0;
    var dash_end = stroke.shape_px.x;
    if dash > 0.0 {
        // The nearest one of the dashes that begin on the line.
        let period = 2.0 * dash;
        let nearest = floor(max(stroke.place_px.x, 0.0) / period + 0.25);
        dash_start = min(nearest, floor(dash_end / period)) * period;
        dash_end = min(dash_start + dash, dash_end);
    }
    let beside = stroke.place_px.x - clamp(stroke.place_px.x, dash_start, dash_end);
    let coverage = saturate(half_width + 0.5 - length(vec2f(beside, stroke.place_px.y)));
    if coverage <= 0.0 {
        discard;
    }
    return premultiplied(stroke.color, coverage);
}
