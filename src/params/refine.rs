//! The switches of the refined method, and what each is worth.

use serde::{Deserialize, Serialize};

/// The refinements beyond the paper, each a switch; `method = paper` ignores them all. Formulas: the header of the file that
/// applies each.
///
/// Measured by switching each off alone: the mean over nine rendered scenes of spheres, cups and donuts and, where a second
/// figure stands, over seven others (tori, cubes, ellipsoids, a cylinder, small objects, similar hues, warm and blue lamps). From
/// `vote_light` on: the mean over eleven scenes of printed, marbled, speckled and fading objects; none of these switches changes
/// the plain scenes by .01 dB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[allow(clippy::struct_excessive_bools, reason = "these are the switches themselves")]
pub struct Refine {
    /// Windows are classified by the tail statistic, without dark, clipped and bloomed pixels.
    /// Restored pixels +0.6 and +1.5 dB, ARI of the second set .996 → .999; with true σ 3 and σ0 = 2.5 half of the coverage.
    pub tail_test: bool,
    /// Lines by iteratively reweighted least squares (Tukey); a hypothesis is refitted and grown once more.
    /// Second set: illuminant .43° → .18°, body +0.4 dB.
    pub robust_lines: bool,
    /// Growth starts from every pixel of the area inside the cylinder, not from one. Body vectors .021° → .019°.
    pub all_seeds: bool,
    /// A large linear area that is a broad highlight of its neighbor is absorbed by it.
    /// Body +1.2 and +8.8 dB, restored pixels +3.4 and +7.9 dB, illuminant 10.2° → .16°.
    pub absorb_highlights: bool,
    /// The linear stage is repeated on unexplained pixels with smaller areas. For small objects: none of the scenes measured has
    /// one.
    pub second_look: bool,
    /// Contested pixels take the majority of their surroundings. No salt and pepper at σ ≥ 2.5; at σ 1.25 nothing changes.
    pub proximity_vote: bool,
    /// Regions on one matte line become one where they touch, or where an occluder or a shadow parts them.
    /// ARI .992 → .999 and .986 → .999, IoU .985 → .998.
    pub merge_regions: bool,
    /// The illuminant is a robust intersection of the dichromatic planes, not the mean of highlight directions.
    /// Illuminant 14.6° → .16° and 2.3° → .18°, body +6.1 and +2.8 dB.
    pub robust_illuminant: bool,
    /// Where faint surface reflection has another color than the highlights, the planes are those of the highlights.
    /// A scene with ambient light: illuminant 4.9° → .5°, body +.8 dB, restored pixels +9.5 dB; without, nothing changes.
    pub two_lights: bool,
    /// A region without a highlight candidate still gets a slice once the illuminant is known.
    /// Illuminant 10.1° → .16°, body +2.7 dB.
    pub extend_planes: bool,
    /// Slices end where body and surface reflection would be negative or the matte line ends. At most .001 dB on the scenes
    /// measured; it keeps neighbors' highlights out where planes cross.
    pub slice_bounds: bool,
    /// The body vector is the matte line through black, seen from the outer edge of the cluster.
    /// Body vectors .231° → .019° and .347° → .039°, body +0.4 and +0.8 dB.
    pub edge_body: bool,
    /// The split uses the scene's illuminant instead of the region's own highlight direction.
    /// Body +6.4 and +5.5 dB, surface +8.8 and +7.8 dB, restored pixels +10.9 and +7.9 dB.
    pub scene_illuminant: bool,
    /// Surface reflection below the noise is none. Body +3.7 and +2.9 dB, surface +6.2 and +5.0 dB.
    pub no_negative_surface: bool,
    /// Clipped pixels are restored from all bands that can be believed, with the body of their surroundings as prior.
    /// Restored pixels +13.2 and +4.3 dB, body +8.7 and +4.5 dB.
    pub restore_prior: bool,
    /// Parts of a region that lie apart become regions of their own, unless an occluder or a shadow parts them. No object of
    /// the scenes measured needs it.
    pub split_components: bool,
    /// Where few regions hold, the light is the one that small highlights vote for.
    /// Illuminant 4.7° → 2.7°, 15.1° → .8° on printed and marbled objects, whose body gains 9.5 dB; .7 dB on average.
    pub vote_light: bool,
    /// Ambient light that all matte lines tell of is subtracted before the split.
    /// Seven scenes behind a veil of 3 to 12 counts: body +5.9 dB, restored pixels +9.5 dB; without a veil nothing changes.
    pub ambient_light: bool,
    /// Regions that do not hold are not split by their planes.
    /// Body 23.2 → 32.0 dB (doing nothing: 27.4), the whole picture 27.3 → 32.0 dB.
    pub region_holds: bool,
    /// Where no region holds, pixels are split by their saturation against that of their hue around them.
    /// Body +3.9 dB, the whole picture +5.6 dB.
    pub local_split: bool,
    /// The local split passes over what varies against the body's shading.
    /// Body +1.5 dB, the whole picture +1.0 dB.
    pub texture_test: bool,
    /// The local split takes whole blobs with a strong core.
    /// Body +.4 dB, the whole picture −.2 dB.
    pub hysteresis: bool,
    /// Without believable highlights nothing is split locally.
    /// Gold, black, white and pale objects: body +.3 dB. Scenes with highlights may lose by it: it is a caution.
    pub belief: bool,
    /// Clipped hearts of local highlights take the body around them.
    /// The whole picture +5.1 dB.
    pub clip_repair: bool,
    /// A region whose highlights lie on different shades has a highlight line for each.
    /// In regions where it finds several, 1698 → 278 matte pixels are called highlight, and 3555 → 4281 of 10163 true highlight
    /// pixels; the images do not change.
    pub second_branch: bool,
}

impl Refine {
    /// Every refinement on or off.
    pub const fn all(on: bool) -> Self {
        Self {
            tail_test: on,
            robust_lines: on,
            all_seeds: on,
            absorb_highlights: on,
            second_look: on,
            proximity_vote: on,
            merge_regions: on,
            robust_illuminant: on,
            two_lights: on,
            extend_planes: on,
            slice_bounds: on,
            edge_body: on,
            scene_illuminant: on,
            no_negative_surface: on,
            restore_prior: on,
            split_components: on,
            vote_light: on,
            ambient_light: on,
            region_holds: on,
            local_split: on,
            texture_test: on,
            hysteresis: on,
            belief: on,
            clip_repair: on,
            second_branch: on,
        }
    }

    /// What a switch does, in one sentence that names the paper's section; empty for a name that is none.
    pub fn meaning(name: &str) -> &'static str {
        match name {
            "tail_test" => {
                "Windows are classified by the sum of their small eigenvalues, without dark and clipped pixels (5.2.1)."
            }
            "robust_lines" => {
                "Matte lines are fitted robustly, and each hypothesis is fitted and grown once more (5.3)."
            }
            "all_seeds" => {
                "Growth starts from every pixel of the area that lies in the cylinder, not from one (5.3)."
            }
            "absorb_highlights" => {
                "A linear area that is a broad highlight of its neighbor is absorbed by it (5.3, 5.4)."
            }
            "second_look" => "The linear stage is repeated on unexplained pixels with smaller areas (5.3).",
            "proximity_vote" => "Pixels that two cylinders hold go the way of their surroundings (5.3).",
            "merge_regions" => {
                "Regions on one matte line become one where they touch or a shadow or occluder parts them (5.3, 5.5)."
            }
            "robust_illuminant" => {
                "The light is where the dichromatic planes intersect, not the mean of highlight directions (5.4)."
            }
            "two_lights" => {
                "Where faint surface reflection has another color than the highlights, these tell the light (7.5)."
            }
            "extend_planes" => {
                "A region without a highlight candidate gets a plane once the light is known (5.4)."
            }
            "slice_bounds" => "A slice ends where body or surface reflection would be negative (5.4).",
            "edge_body" => {
                "The body vector is the matte line through black, seen from the cluster's outer edge (6)."
            }
            "scene_illuminant" => {
                "All regions are split with the scene's light, not each with its own highlight's direction (6)."
            }
            "no_negative_surface" => "Surface reflection below the noise is taken to be none (6).",
            "restore_prior" => {
                "Clipped pixels are restored from the bands that can be believed and from their surroundings (5.5, 6)."
            }
            "split_components" => "Parts of a region that lie apart become regions of their own (5.5).",
            "vote_light" => "Small highlights vote for the light; where few regions hold, they decide (5.4).",
            "ambient_light" => {
                "The point away from black where the matte lines meet is subtracted before the split (7.5)."
            }
            "region_holds" => {
                "Where a region's pixels do not fit its plane, or vary like a print, the plane is not used (3)."
            }
            "local_split" => {
                "Where no region holds, what is paler than its hue around it is taken for a highlight (6)."
            }
            "texture_test" => "The local split passes over what varies against the body like a print (6).",
            "hysteresis" => "The local split takes faint blobs that have a strong core, and no others (6).",
            "belief" => "Where highlights or light are not believable, nothing is split locally (6).",
            "clip_repair" => "Clipped hearts of local highlights take the body that surrounds them (5.5, 6).",
            "second_branch" => {
                "A region whose highlights lie on different shades has a highlight line for each (7.4, figure 13)."
            }
            _ => "",
        }
    }

    /// Names and switches, in the order in which they take effect.
    pub fn switches(&mut self) -> [(&'static str, &mut bool); 25] {
        [
            ("tail_test", &mut self.tail_test),
            ("robust_lines", &mut self.robust_lines),
            ("all_seeds", &mut self.all_seeds),
            ("absorb_highlights", &mut self.absorb_highlights),
            ("second_look", &mut self.second_look),
            ("proximity_vote", &mut self.proximity_vote),
            ("merge_regions", &mut self.merge_regions),
            ("robust_illuminant", &mut self.robust_illuminant),
            ("two_lights", &mut self.two_lights),
            ("extend_planes", &mut self.extend_planes),
            ("slice_bounds", &mut self.slice_bounds),
            ("edge_body", &mut self.edge_body),
            ("scene_illuminant", &mut self.scene_illuminant),
            ("no_negative_surface", &mut self.no_negative_surface),
            ("restore_prior", &mut self.restore_prior),
            ("split_components", &mut self.split_components),
            ("vote_light", &mut self.vote_light),
            ("ambient_light", &mut self.ambient_light),
            ("region_holds", &mut self.region_holds),
            ("local_split", &mut self.local_split),
            ("texture_test", &mut self.texture_test),
            ("hysteresis", &mut self.hysteresis),
            ("belief", &mut self.belief),
            ("clip_repair", &mut self.clip_repair),
            ("second_branch", &mut self.second_branch),
        ]
    }
}

impl Default for Refine {
    fn default() -> Self {
        Self::all(true)
    }
}
