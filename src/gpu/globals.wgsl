// Text that precedes each shader. `Globals` in upload.rs has this layout.

struct Globals {
    clip_from_world: mat4x4f,
    // Size of the target, physical pixels.
    size_px: vec2f,
    // Physical pixels per logical pixel.
    scale: f32,
    padding: f32,
    // Position of the viewer: a point (w = 1) or, without perspective, a direction (w = 0).
    viewer: vec4f,
}

@group(0) @binding(0) var<uniform> globals: Globals;

// From pixels, y downwards, to clip space without perspective, so that shapes in pixels keep their form.
fn clip_from_px(at_px: vec2f, depth: f32) -> vec4f {
    let ndc = at_px / globals.size_px * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0);
    return vec4f(ndc, depth, 1.0);
}

fn px_from_clip(clip: vec4f) -> vec2f {
    return (clip.xy / clip.w * vec2f(0.5, -0.5) + 0.5) * globals.size_px;
}

fn premultiplied(color: vec4f, coverage: f32) -> vec4f {
    let alpha = color.a * coverage;
    return vec4f(color.rgb * alpha, alpha);
}
