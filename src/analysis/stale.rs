//! Which stages a changed parameter makes stale: the first that looks at it, and all after that.
//!
//! A stage's output is kept beside what the stages up to it look at; what only later ones do is blanked out there.

use super::Stage;
use crate::params::{AmbientSetting, Refine, UsedParams};

/// The numbers and refinements that `stage` and those before it look at.
///
/// The limits of the masks are not blanked for any stage; windows and noise matter from classification on, cylinders and
/// areas from the linear stage on, slices and a given light from the planar one on, ambient light in the split.
pub fn seen_up_to(stage: Stage, used: &UsedParams, refine: Refine) -> (UsedParams, Refine) {
    let (mut used, mut refine) = (*used, refine);
    if stage < Stage::Linear {
        (used.cylinder_width, used.min_area) = (0.0, 0.0);
    }
    if stage < Stage::Planar {
        used.slice_width = 0.0;
        used.illuminant = None;
    }
    if stage < Stage::Split {
        used.ambient = AmbientSetting::Auto;
    }
    for (name, switch) in refine.switches() {
        *switch &= first_stage(name) <= stage;
    }
    (used, refine)
}

/// The first stage that looks at a switch.
fn first_stage(switch: &str) -> Stage {
    match switch {
        "tail_test" => Stage::Classify,
        "robust_lines" | "all_seeds" | "absorb_highlights" | "second_look" | "proximity_vote"
        | "merge_regions" => Stage::Linear,
        "robust_illuminant" | "two_lights" | "extend_planes" | "slice_bounds" | "vote_light" => Stage::Planar,
        "split_components" => Stage::Clipping,
        "edge_body"
        | "scene_illuminant"
        | "no_negative_surface"
        | "restore_prior"
        | "ambient_light"
        | "region_holds"
        | "local_split"
        | "texture_test"
        | "hysteresis"
        | "belief"
        | "clip_repair"
        | "second_branch" => Stage::Split,
        // One that is not listed makes everything stale, which is slow but never wrong.
        _ => Stage::Masks,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_switch_is_listed() {
        for (name, _) in Refine::default().switches() {
            assert_ne!(first_stage(name), Stage::Masks, "{name}");
        }
    }
}
