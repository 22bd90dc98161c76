//! The switches of the refined method, and the measured effect of each.
//!
//! One row of the table makes a switch known everywhere: the field of [`Refine`], the variant of [`Switch`], the values of
//! `--with` and `--without`, the key of a parameter file, the checkbox with its tooltip, the stages that run again after a
//! change, and a line of `docs/parameters.md`. Formulas stand in the header of the file that applies a switch.

use super::nearest::hint;
use super::stage::Stage;
use serde::{Deserialize, Serialize};

macro_rules! switches {
    ($($field:ident $variant:ident {
        $(was: $former:literal,)? first_stage: $stage:ident, meaning: $meaning:literal, worth: $worth:literal,
    })*) => {
        /// The refinements beyond the paper, each a switch; `method = paper` uses only those that are added to it.
        ///
        /// Measured effects come from switching each off alone. They are means over nine rendered scenes of spheres, cups
        /// and donuts and, where a second number stands, over a second set of seven scenes (tori, cubes, ellipsoids, a
        /// cylinder, small objects, similar hues, warm and blue lamps). From `vote_light` on they are means over eleven
        /// scenes of printed, marbled, speckled and fading objects, unless the effect names other pictures.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields)]
        #[allow(clippy::struct_excessive_bools, reason = "these are the switches themselves")]
        pub struct Refine {
            $(#[doc = $meaning] #[doc = ""] #[doc = $worth] $(#[serde(alias = $former)])? pub $field: bool,)*
        }

        impl Refine {
            /// Every refinement on or off.
            pub const fn all(on: bool) -> Self {
                Self { $($field: on),* }
            }

            /// Whether a switch is on.
            pub const fn get(&self, switch: Switch) -> bool {
                match switch {
                    $(Switch::$variant => self.$field,)*
                }
            }

            /// Turns a switch on or off.
            pub const fn set(&mut self, switch: Switch, on: bool) {
                match switch {
                    $(Switch::$variant => self.$field = on,)*
                }
            }
        }

        /// The name of a refinement: a field of [`Refine`] as a value.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Switch {
            $(#[doc = $meaning] $variant,)*
        }

        impl Switch {
            /// All switches, in the order in which they take effect.
            pub const ALL: [Self; [$(stringify!($field)),*].len()] = [$(Self::$variant),*];

            /// The switch's name in code, on the command line, in files and reports.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($field),)*
                }
            }

            /// The first stage that reads the switch. A change makes this stage and all later ones stale.
            pub const fn first_stage(self) -> Stage {
                match self {
                    $(Self::$variant => Stage::$stage,)*
                }
            }

            /// What the switch does when it is on, in one sentence that names the paper's section.
            pub const fn meaning(self) -> &'static str {
                match self {
                    $(Self::$variant => $meaning,)*
                }
            }

            /// The measured effect, as [`Refine`] says it was measured.
            pub const fn worth(self) -> &'static str {
                match self {
                    $(Self::$variant => $worth,)*
                }
            }
        }
    };
}

switches! {
    clipped_objects ClippedObjects {
        first_stage: Masks,
        meaning: "A clipped area with an abrupt edge is a thing that clips, such as the sky between leaves or white paint, and no highlight: it keeps its colors (4).",
        worth: "37 rendered scenes at JPEG 92 with white seen through holes: body 22.9 → 30.4 dB (doing nothing: 28.9), with white letters 28.6 → 32.8 dB (27.9); 370 pictures without white things: nothing changes.",
    }
    tail_test TailTest {
        first_stage: Classify,
        meaning: "Windows are classified by the sum of their small eigenvalues, without dark and clipped pixels (5.2.1).",
        worth: "Restored pixels +0.6 and +1.5 dB, ARI of the second set .996 → .999; with true σ 3 and σ0 = 2.5 half of the coverage.",
    }
    robust_lines RobustLines {
        first_stage: Linear,
        meaning: "Matte lines are fitted robustly, and each hypothesis is fitted and grown once more (5.3).",
        worth: "Second set: illuminant .43° → .18°, body +0.4 dB.",
    }
    all_seeds AllSeeds {
        first_stage: Linear,
        meaning: "Growth starts from every pixel of the area that lies in the cylinder, not from one (5.3).",
        worth: "Body vectors .021° → .019°.",
    }
    absorb_highlights AbsorbHighlights {
        first_stage: Linear,
        meaning: "A linear area that is a broad highlight of its neighbor is absorbed by it (5.3, 5.4).",
        worth: "Body +1.2 and +8.8 dB, restored pixels +3.4 and +7.9 dB, illuminant 10.2° → .16°.",
    }
    second_look SecondLook {
        first_stage: Linear,
        meaning: "The linear stage is repeated on unexplained pixels with smaller areas (5.3).",
        worth: "For small objects; none of the scenes measured has one.",
    }
    proximity_vote ProximityVote {
        first_stage: Linear,
        meaning: "Pixels that two cylinders hold go the way of their surroundings (5.3).",
        worth: "No salt and pepper at σ ≥ 2.5; at σ 1.25 nothing changes.",
    }
    merge_regions MergeRegions {
        first_stage: Linear,
        meaning: "Regions on one matte line become one where they touch or a shadow or occluder parts them (5.3, 5.5).",
        worth: "ARI .992 → .999 and .986 → .999, IoU .985 → .998.",
    }
    robust_illuminant RobustIlluminant {
        first_stage: Planar,
        meaning: "The light is where the dichromatic planes intersect, not the mean of highlight directions (5.4).",
        worth: "Illuminant 14.6° → .16° and 2.3° → .18°, body +6.1 and +2.8 dB.",
    }
    two_lights TwoLights {
        first_stage: Planar,
        meaning: "Where faint surface reflection has another color than the highlights, these tell the light (7.5).",
        worth: "A scene with ambient light: illuminant 4.9° → .5°, body +.8 dB, restored pixels +9.5 dB; without, nothing changes.",
    }
    second_lamp SecondLamp {
        first_stage: Planar,
        meaning: "Regions whose highlights contradict the light and agree on another one are split with that second lamp (7.5).",
        worth: "Twelve scenes of balls under two lamps, in eight of which both are found: body 35.2 → 40.8 dB (doing nothing: 28.2); under one lamp nothing changes.",
    }
    extend_planes ExtendPlanes {
        first_stage: Planar,
        meaning: "A region without a highlight candidate gets a plane once the light is known (5.4).",
        worth: "Illuminant 10.1° → .16°, body +2.7 dB.",
    }
    slice_bounds SliceBounds {
        first_stage: Planar,
        meaning: "A slice ends where body or surface reflection would be negative (5.4).",
        worth: "At most .001 dB on the scenes measured; it keeps neighbors' highlights out where planes cross.",
    }
    edge_body EdgeBody {
        first_stage: Split,
        meaning: "The body vector is the matte line through black, seen from the cluster's outer edge (6).",
        worth: "Body vectors .231° → .019° and .347° → .039°, body +0.4 and +0.8 dB.",
    }
    scene_illuminant SceneIlluminant {
        first_stage: Split,
        meaning: "All regions are split with the scene's light, not each with its own highlight's direction (6).",
        worth: "Body +6.4 and +5.5 dB, surface +8.8 and +7.8 dB, restored pixels +10.9 and +7.9 dB.",
    }
    no_negative_surface NoNegativeSurface {
        first_stage: Split,
        meaning: "Surface reflection below the noise is taken to be none (6).",
        worth: "Body +3.7 and +2.9 dB, surface +6.2 and +5.0 dB.",
    }
    restore_prior RestorePrior {
        first_stage: Split,
        meaning: "Clipped pixels are restored from the bands that can be believed and from their surroundings (5.5, 6).",
        worth: "Restored pixels +16.8 dB, body +9.0 dB over the nine scenes.",
    }
    clipped_bands ClippedBands {
        first_stage: Clipping,
        meaning: "A region takes a clipped pixel only where its body and surface reflection can have the bands that do not clip (5.5).",
        worth: "A scene of plain objects at 1.25 times full exposure: 24.6 → 30.6 dB (doing nothing: 30.1), as a ball no longer goes to the object beside it; 37 scenes as they are and at JPEG 92 change by at most .02 dB.",
    }
    split_components SplitComponents {
        first_stage: Clipping,
        meaning: "Parts of a region that lie apart become regions of their own (5.5).",
        worth: "No object of the scenes measured needs it.",
    }
    vote_light VoteLight {
        first_stage: Planar,
        meaning: "Small highlights vote for the light; where few regions hold, they decide (5.4).",
        worth: "Illuminant 4.7° → 2.7°, 15.1° → .8° on printed and marbled objects, whose body gains 9.5 dB; .7 dB on average.",
    }
    ambient_light AmbientLight {
        first_stage: Split,
        meaning: "The point away from black where the matte lines meet is subtracted before the split (7.5).",
        worth: "Seven scenes behind a veil of 3 to 12 counts: body +5.9 dB, restored pixels +9.5 dB; without a veil nothing changes.",
    }
    coding_error CodingError {
        first_stage: Planar,
        meaning: "Fits are judged by the noise and by the error that tone curve and compression of the file make (5.4).",
        worth: "Plain objects, compressed or demosaiced: regions that the model fits 197 → 335 of 366; body +3.0 dB at JPEG 95, +.1 at JPEG 92, −.2 demosaiced.",
    }
    shot_noise ShotNoise {
        first_stage: Planar,
        meaning: "Fits are judged by the noise at the intensity of their pixels, which grows with the light (7.3).",
        worth: "Plain objects with shot noise: regions that the model fits 76 → 85 of 94, body +.5 dB (doing nothing: 22.6); where the noise is the same everywhere, nothing changes.",
    }
    border_mixtures BorderMixtures {
        first_stage: Split,
        meaning: "A pixel near another region has no more surface reflection than the pixels further inside its own: its color is mixed (5.6).",
        worth: "Compressed pictures of objects before walls: body +5.6 to +8.8 dB; plain objects +.03 to +1 dB.",
    }
    region_holds RegionHolds {
        first_stage: Split,
        meaning: "Where a region's pixels do not fit its plane, or vary like a print, the plane is not used (3).",
        worth: "Body 23.2 → 32.0 dB (doing nothing: 27.4), the whole picture 27.3 → 32.0 dB.",
    }
    border_edges BorderEdges {
        first_stage: Split,
        meaning: "Where the split of a region makes edges at its border that the photograph does not have, the region is only a part of an object, and its plane is not used (3).",
        worth: "20 photographs, border of the split with edges that the photograph does not have: 14.5 → 8.1 %; animals, inside highlights, 32.1 → 32.9 dB (doing nothing: 22.3); plain objects lose nothing.",
    }
    plane_evidence PlaneEvidence {
        first_stage: Split,
        meaning: "Where what the plane of a region takes for surface reflection looks like print, the plane is not used; asked in compressed and demosaiced photographs, and where the light is hardly told from the body (3).",
        worth: "20 photographs, border of the split with edges that the photograph does not have: 2.1 → 1.2 %; rendered scenes at JPEG 92, body of other kinds than plain objects, 32.8 → 33.0 dB (doing nothing: 23.9).",
    }
    far_colors FarColors {
        first_stage: Split,
        meaning: "Patches of a region whose colors lie far from its plane belong to another object, and the plane is not used there (5.5).",
        worth: "Balls of 12 to 34 pixels before a wall, eight scenes: the worst ball against doing nothing −26.6 → 0 dB, the mean of the balls +1.3 dB; 37 scenes with ground truth, as they are and as five cameras store them, lose at most .07 dB.",
    }
    small_objects SmallObjects {
        first_stage: Split,
        meaning: "What the working picture of a large photograph leaves unexplained is sought again in a finer picture, under the same light (5).",
        worth: "Four pictures of 12 megapixels, each with 24 balls of 60 to 200 pixels: 62 → 96 of the 96 are regions, body 38.4 → 41.1 dB (doing nothing: 29.3).",
    }
    local_split LocalSplit {
        first_stage: Split,
        meaning: "Where no region holds, what is paler than its hue around it is taken for a highlight (6).",
        worth: "Body +3.9 dB, the whole picture +5.6 dB.",
    }
    region_ratio RegionRatio {
        first_stage: Split,
        meaning: "Where a region is one material and clearly paler than its hue around it, its own ratio tells highlights where no region holds (6).",
        worth: "A scene with a pale ball before a wall of the same hue, at JPEG 92: 34.1 → 42.8 dB (doing nothing: 34.0); four of 20 photographs change, by 58 dB or more between before and after.",
    }
    highlight_evidence HighlightEvidence {
        was: "texture_test",
        first_stage: Split,
        meaning: "Four observations tell highlights from white print where no region holds: chroma, independence of the body, brightness, edges (6).",
        worth: "Six printed scenes: the whole picture 31.4 → 35.4 dB (doing nothing: 21.5); photographs with measured truth, inside highlights: animals 30.4 → 32.1 dB, fruit 34.9 → 36.3 dB, together with guided_amount.",
    }
    guided_amount GuidedAmount {
        was: "hysteresis",
        first_stage: Split,
        meaning: "The surface reflection of the local split follows the edges of the picture, so that the split makes no edges of its own (6).",
        worth: "Six printed scenes: the whole picture 34.5 → 35.4 dB (doing nothing: 21.5).",
    }
    hue_restoration HueRestoration {
        first_stage: Split,
        meaning: "Where one band alone is clipped and no region explains the pixel, the band comes from the other two and the hue around (6).",
        worth: "48 overexposed pictures: inside highlights 19.5 → 20.4 dB (doing nothing: 14.0), fruit 25.0 → 29.1, a print 17.6 → 22.4; the highlight of an orange whose red clips is found; 37 scenes as they are +.05 dB on average.",
    }
    chromaticity_prior ChromaticityPrior {
        first_stage: Split,
        meaning: "Inside highlights that no region explains, the chromaticity of body reflection comes from the pixels around as well, as far as the errors of light and file explain the difference (6).",
        worth: "Photographs with measured truth, inside highlights: animals 33.0 → 33.2 dB (doing nothing: 22.3), fruit 35.9 → 36.4 dB (doing nothing: 17.4); 37 rendered scenes, as they are and at JPEG 92: none loses, mean +.02 dB, at most +.2 dB.",
    }
    belief Belief {
        first_stage: Split,
        meaning: "Where too few votes are for the light, nothing is split locally (6).",
        worth: "A caution for gold, black, white and pale objects; nothing changes in scenes with highlights.",
    }
    clip_repair ClipRepair {
        first_stage: Split,
        meaning: "Clipped cores of local highlights take the body that surrounds them (5.5, 6).",
        worth: "Six printed scenes: the whole picture 24.5 → 35.4 dB (doing nothing: 21.5).",
    }
    second_branch SecondBranch {
        first_stage: Split,
        meaning: "A region whose highlights lie on different shades has a highlight line for each (7.4, figure 13).",
        worth: "In regions where it finds several, 1698 → 278 matte pixels are called highlight, and 3555 → 4281 of 10163 true highlight pixels; the images do not change.",
    }
}

impl Switch {
    /// The switch of a name.
    ///
    /// # Errors
    /// [`UnknownSwitch`] for any other text.
    pub fn from_name(name: &str) -> Result<Self, UnknownSwitch> {
        let known = Self::ALL.into_iter().find(|switch| switch.name() == name);
        known.ok_or_else(|| UnknownSwitch(name.to_owned()))
    }
}

/// A text that is no switch's name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is the name of no refinement{close}", close = hint(.0, Switch::ALL.map(Switch::name)))]
pub struct UnknownSwitch(pub String);

impl Default for Refine {
    fn default() -> Self {
        Self::all(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_leads_to_its_own_field_and_any_other_text_is_an_error() {
        for switch in Switch::ALL {
            assert_eq!(Switch::from_name(switch.name()), Ok(switch));
            let mut refine = Refine::all(false);
            refine.set(switch, true);
            let on = Switch::ALL.into_iter().filter(|&other| refine.get(other));
            assert_eq!(on.collect::<Vec<_>>(), [switch]);
            let text = toml::to_string(&refine).unwrap();
            assert!(text.contains(&format!("{} = true", switch.name())), "{text}");
        }
        let former: Refine = toml::from_str("texture_test = false\nhysteresis = true").unwrap();
        assert!(!former.highlight_evidence && former.guided_amount, "names of earlier versions");
        let error = Switch::from_name("second-look").unwrap_err();
        assert_eq!(
            error.to_string(),
            "\"second-look\" is the name of no refinement; did you mean `second_look`?"
        );
    }
}
