// Translucent solids and sheets. Vertices are `Vertex`es of scene.rs.

struct Surface {
    @builtin(position) position: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) color: vec4f,
}

@vertex
fn vertex(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) color: vec4f,
) -> Surface {
    return Surface(globals.clip_from_world * vec4f(position, 1.0), position, normal, color);
}

// Brightness of a surface perpendicular to the viewer's direction, as a share of the surface's color.
const DIMMEST = 0.6;
// Least cosine for the thickness of the skin, so that the silhouette is a line of a few pixels and not opaque.
const GRAZING = 0.18;

@fragment
fn fragment(surface: Surface) -> @location(0) vec4f {
    let to_viewer = normalize(globals.viewer.xyz - surface.world * globals.viewer.w);
    let facing = abs(dot(normalize(surface.normal), to_viewer));
    // The surface is a skin of constant thickness: light crosses 1 / cos of the thickness, and each layer transmits the same
    // share. A cylinder therefore has a light middle and dark rims, like a glass tube.
    let through = pow(1.0 - surface.color.a, 1.0 / max(facing, GRAZING));
    let shaded = surface.color.rgb * mix(DIMMEST, 1.0, facing);
    // Towards the silhouette of a round body the cosine falls like the square root of the distance. The distance in pixels is
    // computed from the cosine, for a soft edge without more samples per pixel. Flat faces are everywhere far from such an edge.
    let inside_px = 0.5 * facing / max(fwidth(facing), 1e-6);
    return premultiplied(vec4f(shaded, 1.0 - through), saturate(inside_px));
}
