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

// Share of the color that is left where the surface turns away from the viewer.
const DIMMEST = 0.6;
// Below this cosine the skin gets no thicker: the silhouette is a line of a few pixels, not a hard wall.
const GRAZING = 0.18;

@fragment
fn fragment(surface: Surface) -> @location(0) vec4f {
    let to_viewer = normalize(globals.viewer.xyz - surface.world * globals.viewer.w);
    let facing = abs(dot(normalize(surface.normal), to_viewer));
    // A skin of even thickness: light crosses 1 / cos of it, and each layer lets the same share through. So a
    // cylinder has a light middle and dark rims, as a tube of glass has.
    let through = pow(1.0 - surface.color.a, 1.0 / max(facing, GRAZING));
    let shaded = surface.color.rgb * mix(DIMMEST, 1.0, facing);
    // Towards the silhouette of a round body the cosine falls like the square root of the distance, which this
    // recovers, in pixels: a soft edge without more samples a pixel. Flat faces are far from it everywhere.
    let inside_px = 0.5 * facing / max(fwidth(facing), 1e-6);
    return premultiplied(vec4f(shaded, 1.0 - through), saturate(inside_px));
}
