//! The readings of the paper: the places where the text of 1990 can be read in two ways, or where the program deviated from the text.
//!
//! One row of the table makes a reading known everywhere: the field of [`Readings`], the variant of [`Reading`], the values of
//! `--reading` and `--without-reading`, the key under `[paper]` in a parameter file, the check box with its tooltip, the stages that run
//! again after a change, and a line of `docs/readings.md`.
//!
//! The measured effects come from switching each reading alone against the defaults. The four pictures of the paper are rendered scenes
//! with known truth after color figures 1 and 12 to 14, each analyzed with its column of table 6. The nine scenes add four spheres
//! and a pair of spheres to them, with the first column of table 6. All figures are means.
//!
//! Both methods read the same switches. The paper's method takes what a person asked for, by default the column `paper` of the
//! table. The refined method takes the fixed column `refined`.

use super::nearest::hint;
use super::stage::Stage;
use serde::{Deserialize, Serialize};

macro_rules! readings {
    ($($field:ident $variant:ident {
        first_stage: $stage:ident, paper: $paper:literal, refined: $refined:literal,
        title: $title:literal, section: $section:literal, text: $text:literal,
        on: $on:literal, off: $off:literal, measured: $measured:literal,
    })*) => {
        /// How the text of 1990 is read: one switch per reading.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields)]
        #[allow(clippy::struct_excessive_bools, reason = "these are the switches themselves")]
        pub struct Readings {
            $(#[doc = $title] #[doc = ""] #[doc = concat!("On: ", $on)] #[doc = ""] #[doc = concat!("Off: ", $off)] pub $field: bool,)*
        }

        impl Readings {
            /// The defaults of the paper's method.
            pub const PAPER: Self = Self { $($field: $paper),* };

            /// The readings of the refined method, which cannot be changed.
            pub const REFINED: Self = Self { $($field: $refined),* };

            /// Every reading on or off.
            pub const fn all(on: bool) -> Self {
                Self { $($field: on),* }
            }

            /// Whether a reading is on.
            pub const fn get(&self, reading: Reading) -> bool {
                match reading {
                    $(Reading::$variant => self.$field,)*
                }
            }

            /// Turns a reading on or off.
            pub const fn set(&mut self, reading: Reading, on: bool) {
                match reading {
                    $(Reading::$variant => self.$field = on,)*
                }
            }
        }

        /// The name of a reading: a field of [`Readings`] as a value.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Reading {
            $(#[doc = $title] $variant,)*
        }

        impl Reading {
            /// All readings, in the order of the sections that they rest on.
            pub const ALL: [Self; [$(stringify!($field)),*].len()] = [$(Self::$variant),*];

            /// The row of the table.
            pub const fn spec(self) -> ReadingSpec {
                match self {
                    $(Self::$variant => ReadingSpec {
                        name: stringify!($field),
                        title: $title,
                        section: $section,
                        text: $text,
                        on: $on,
                        off: $off,
                        measured: $measured,
                        first_stage: Stage::$stage,
                        paper: $paper,
                        refined: $refined,
                    },)*
                }
            }
        }
    };
}

/// What flags, files, check boxes and documents need to know of a reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadingSpec {
    /// The reading's name in code, on the command line, in files and reports.
    pub name: &'static str,
    /// What the reading is about, in a few words.
    pub title: &'static str,
    /// The section of the paper that contains the sentence.
    pub section: &'static str,
    /// The sentence of the paper that the reading rests on, word for word.
    pub text: &'static str,
    /// What the method does when the reading is on, one sentence.
    pub on: &'static str,
    /// What the method does when the reading is off, one sentence.
    pub off: &'static str,
    /// The measured consequences of both, and why the default is the default.
    pub measured: &'static str,
    /// The first stage that asks for the reading. A change makes this stage and all later ones stale.
    pub first_stage: Stage,
    /// Whether the reading is on by default in the paper's method.
    pub paper: bool,
    /// Whether the reading is on in the refined method.
    pub refined: bool,
}

impl ReadingSpec {
    /// The tooltip and the text of the help: section, sentence, and both consequences.
    pub fn explanation(&self) -> String {
        let Self { section, text, on, off, .. } = self;
        let default = if self.paper { "on" } else { "off" };
        format!("Section {section}: \u{201c}{text}\u{201d}\nOn: {on}\nOff: {off}\nDefault: {default}.")
    }
}

readings! {
    every_pixel EveryPixel {
        first_stage: Linear, paper: true, refined: false,
        title: "fits to every pixel",
        section: "5.2.1",
        text: "It projects the color pixels from one window at a time into the color space and finds the principal components of the color distributions",
        on: "Lines, lengths and weights are computed from every pixel of an area or region.",
        off: "Lines and weights are computed from at most 4000 evenly chosen pixels, lengths and vectors from at most 6000.",
        measured: "Four pictures of the paper: light 3.36\u{b0} on, 3.39\u{b0} off; body 35.30 and 35.29 dB. The text knows no sample.",
    }
    brightest_pixel BrightestPixel {
        first_stage: Linear, paper: true, refined: false,
        title: "length to the brightest matte pixel",
        section: "5.4.1",
        text: "the algorithm chooses the brightest matte point only from pixels with color values on the outside of the matte line",
        on: "The matte line ends at the brightest pixel on its outer side.",
        off: "The matte line ends at the 99.5 % quantile of the pixels on its outer side.",
        measured: "Four pictures: light 3.36\u{b0} on, 3.35\u{b0} off. Nine scenes: light 2.4\u{b0} on, 4.0\u{b0} off; body 35.1 and 34.6 dB. The text knows no quantile.",
    }
    grown_matte_line GrownMatteLine {
        first_stage: Planar, paper: false, refined: false,
        title: "matte line of the grown region",
        section: "5.4.1",
        text: "It uses their color means and first eigenvectors to describe a matte and a prospective highlight line",
        on: "The matte line of a skewed T is that of all pixels of the grown region.",
        off: "The matte line of a skewed T is that of the area from which the region grew, the axis of the cylinder.",
        measured: "Four pictures: body vectors .25\u{b0} on, .26\u{b0} off; body 35.29 and 35.30 dB. Both readings are possible; off is better by a little, and the axis is the line that the text calls the linear hypothesis.",
    }
    distorted_candidates DistortedCandidates {
        first_stage: Planar, paper: false, refined: false,
        title: "clipped and bloomed pixels in highlight candidates",
        section: "5.4.1",
        text: "Since many such highlight areas are very small and since they may contain some clipped and bloomed pixels, the orientations of their color clusters may vary significantly.",
        on: "Highlight candidates contain their clipped and bloomed pixels.",
        off: "Clipped and bloomed pixels are left out of highlight candidates (\u{201c}a heuristic to discard bloomed pixels\u{201d}, section 7.3).",
        measured: "Four pictures: light 12.4\u{b0} on, 3.4\u{b0} off (yellow 23.5\u{b0} and 7.1\u{b0}, white 12.2\u{b0} and 2.5\u{b0}, pink 10.5\u{b0} and 3.2\u{b0}); body 37.2 and 35.3 dB. A sphere at a phase angle of 120\u{b0} has a light on (2.5\u{b0}), none off. Both readings are possible; off reproduces the illumination vectors of tables 2 to 5.",
    }
    all_neighbors AllNeighbors {
        first_stage: Planar, paper: true, refined: false,
        title: "candidates of any size and class",
        section: "5.4.1",
        text: "the algorithm considers all neighbors of a linear region as prospective highlight candidates",
        on: "Every neighbor with a first eigenvector is a candidate.",
        off: "Neighbors of fewer than 10 pixels, and neighbors of class point, are no candidates.",
        measured: "Four pictures: light 3.4\u{b0} on, 4.1\u{b0} off; restored pixels 21.7 and 20.1 dB, body 35.3 and 35.6 dB. The text is plain.",
    }
    gap_within_noise GapWithinNoise {
        first_stage: Planar, paper: true, refined: false,
        title: "lines meet within the camera noise",
        section: "5.4.1",
        text: "Comparing the distance to the camera noise, the algorithm decides whether the clusters meet in a skewed T.",
        on: "The lines of a skewed T pass each other within the camera noise \u{3c3}0.",
        off: "The lines of a skewed T pass each other within the radius of the cylinder, 4\u{3c3}0.",
        measured: "Four pictures: light 3.4\u{b0} on, 4.1\u{b0} off; surface 37.5 and 37.2 dB. The text is plain: the camera noise is \u{3c3}0 in table 6.",
    }
    strict_upper_half StrictUpperHalf {
        first_stage: Planar, paper: true, refined: false,
        title: "meeting point no farther than the end of the matte line",
        section: "5.4.1",
        text: "Similarly, the algorithm tests whether the clusters intersect in the upper 50% of the matte cluster.",
        on: "The meeting point lies between 50 and 100 % of the matte line.",
        off: "The meeting point lies between 50 and 110 % of the matte line, and a radius of the cylinder beyond.",
        measured: "Four pictures and nine scenes: no difference. The text is plain.",
    }
    beyond_meeting_point BeyondMeetingPoint {
        first_stage: Planar, paper: true, refined: true,
        title: "positive direction seen from the meeting point",
        section: "5.4.1",
        text: "We also check whether the neighboring cluster has a positive direction\u{2014}a test related to the additive properties of body and surface reflection.",
        on: "The direction of a candidate is positive in every band, and leads from the meeting point to the candidate's mean.",
        off: "The direction of a candidate is positive in every band, on whichever side of the meeting point the candidate lies.",
        measured: "Four pictures: light 3.4\u{b0} on, 5.1\u{b0} off (pink 3.2\u{b0} and 10.0\u{b0}); body 35.3 and 34.6 dB. A sphere at a phase angle of 10\u{b0}: light 1.6\u{b0} on, 14.2\u{b0} off. Both readings are possible; on reproduces the pictures.",
    }
    gershon_test GershonTest {
        first_stage: Planar, paper: false, refined: false,
        title: "Gershon's test in place of the 50 % heuristic",
        section: "5.4.1",
        text: "Gershon has tested whether two clusters are nearly parallel or whether they intersect, suspecting that parallel clusters are neighboring matte clusters. We replace this test by the more precise 50% heuristic of section 3",
        on: "A candidate whose line meets the matte line at an angle of 10\u{b0} or more passes, wherever the lines meet.",
        off: "A candidate whose line meets the matte line in its upper half passes, at whatever angle.",
        measured: "Nine scenes: of 181 candidates, 144 of them highlights, the 50 % heuristic accepts 105 and no other; Gershon's test accepts 109 and 17 others. Body 30.8 dB on, 35.1 dB off; light of the eight plastic objects 14.9\u{b0} on, 0.6\u{b0} off. The text says that it replaces this test.",
    }
    chosen_start ChosenStart {
        first_stage: Planar, paper: true, refined: false,
        title: "highlight line starts at the chosen candidate's meeting point",
        section: "5.4.1",
        text: "It then selects the highlight region whose intersection point is closest to the average.",
        on: "The highlight line starts at the meeting point of the candidate that was selected.",
        off: "The highlight line starts at the weighted average of the meeting points of all candidates.",
        measured: "Four pictures: body 35.30 dB on, 35.08 dB off. Nine scenes: body 35.1 and 35.0 dB. Both readings are possible; on reproduces the pictures.",
    }
    own_cylinder_only OwnCylinderOnly {
        first_stage: Planar, paper: false, refined: false,
        title: "pixels of other matte regions by the own cylinder alone",
        section: "5.4.2",
        text: "When the planar-region growing process encounters pixels from a previously grown matte region other than the starting region, it only continues growing if the pixel lies within the matte color cylinder of the starting region.",
        on: "A pixel of another matte region joins where its color lies in the own cylinder, whatever region it belongs to.",
        off: "A pixel of another matte region joins where its color lies in the own cylinder and nearer to the own axis than to the other axis (the proximity heuristic).",
        measured: "Eight plastic objects: ARI .952 on, .998 off, because dark pixels of the dark red donut join the orange cup. The next sentence of the text names the proximity heuristic, and section 5.6 decides between two donuts by the nearer axis: both readings are possible; off reproduces color figures 6 and 7.",
    }
    single_matte_cluster SingleMatteCluster {
        first_stage: Planar, paper: true, refined: false,
        title: "matte areas of a single cluster are united",
        section: "5.4.2",
        text: "This reflects the observation that if several matte areas exist in an object area, separated by highlight regions, all such matte areas form a single matte cluster.",
        on: "Another matte region joins by the own cylinder alone, if at least 90 % of its pixels lie in the cylinder: both areas form a single matte cluster. Its hypothesis is not applied any more.",
        off: "Two matte regions of one object stay two regions, unless own_cylinder_only unites them.",
        measured: "A cylinder with a highlight along its axis: 1 region on, 2 off. Four pictures and nine scenes: no difference. On reproduces \u{201c}the two matte image areas on the green donut are now united\u{201d}.",
    }
    fill_holes FillHoles {
        first_stage: Clipping, paper: false, refined: true,
        title: "holes in regions are filled",
        section: "5.5",
        text: "Any image processing method for filling holes in image segments, such as a region-expansion operation followed by region shrinking [27], should be able to include these pixels.",
        on: "Clipped holes and small holes inside of a region join the region.",
        off: "Pixels that no growth reached stay outside of the regions.",
        measured: "A sphere at a phase angle of 120\u{b0}: coverage .945 on, .762 off; a sphere at 10\u{b0}: 1.000 and .974. Four pictures: no difference. The text is plain: color figure 7 was not filled.",
    }
    small_regions SmallRegions {
        first_stage: Clipping, paper: true, refined: false,
        title: "regions of any size",
        section: "5.4.2",
        text: "Applying the planar hypotheses one at a time, it proceeds iteratively until no more unprocessed planar hypotheses for large image areas exist.",
        on: "A region of any size stays in the result.",
        off: "A region of fewer than 60 pixels is dropped at the end.",
        measured: "Four pictures and nine scenes: no difference. The text knows no such limit.",
    }
    unsplit_without_highlight UnsplitWithoutHighlight {
        first_stage: Split, paper: true, refined: false,
        title: "a region without a highlight stays as it is",
        section: "6",
        text: "Our algorithm then uses C\u{304}_b and C\u{304}_s of every segmented region to split the pixels into their reflection components.",
        on: "A region without a surface vector is not split: its body reflection is the photograph. Its fit is measured from its own matte line.",
        off: "A region without a surface vector is projected onto a line through black. Its fit is measured from that line.",
        measured: "Nine scenes: body 35.1 dB on, 34.1 dB off (a sphere at a phase angle of 10\u{b0}: 36.8 and 27.4 dB). The text describes no split of such a region.",
    }
    cylinder_noise CylinderNoise {
        first_stage: Split, paper: true, refined: false,
        title: "noise image of regions without a plane",
        section: "6",
        text: "The intrinsic noise image displays the distance \u{3b5} of every pixel in an image area from the associated dichromatic plane, scaled relative to the width of the planar slices and of the cylinders.",
        on: "\u{3b5} of a region without a plane is the distance from its matte line.",
        off: "\u{3b5} of a region without a plane is 0.",
        measured: "Only the noise image changes. The text is plain.",
    }
    angle_by_width AngleByWidth {
        first_stage: Split, paper: true, refined: false,
        title: "least angle by the cylinder width",
        section: "7.5",
        text: "There needs to be a certain angle between the orientations of the body and surface reflection vectors of an object. How big the angle needs to be depends on the cylinder width.",
        on: "A region is split where its highlight cluster, of length L, leaves the cylinder of radius r: sin(angle) > r / L. A note tells where less than half of the cluster lies outside.",
        off: "A region is split where the angle is at least 3\u{b0}. A note tells where the angle is below 14\u{b0}.",
        measured: "A sphere at a phase angle of 10\u{b0}: surface 37.4 dB on, 34.6 dB off, because a part of its highlight is not split by a line of its own. Four pictures: no difference. The text is plain.",
    }
}

impl Reading {
    /// The reading's name in code, on the command line, in files and reports.
    pub const fn name(self) -> &'static str {
        self.spec().name
    }

    /// The first stage that asks for the reading.
    pub const fn first_stage(self) -> Stage {
        self.spec().first_stage
    }

    /// The reading of a name.
    ///
    /// # Errors
    /// [`UnknownReading`] for any other text.
    pub fn from_name(name: &str) -> Result<Self, UnknownReading> {
        let known = Self::ALL.into_iter().find(|reading| reading.name() == name);
        known.ok_or_else(|| UnknownReading(name.to_owned()))
    }
}

/// A text that is no reading's name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is the name of no reading{close}", close = hint(.0, Reading::ALL.map(Reading::name)))]
pub struct UnknownReading(pub String);

impl Default for Readings {
    fn default() -> Self {
        Self::PAPER
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_leads_to_its_own_field_and_any_other_text_is_an_error() {
        for reading in Reading::ALL {
            assert_eq!(Reading::from_name(reading.name()), Ok(reading));
            let mut readings = Readings::all(false);
            readings.set(reading, true);
            let on = Reading::ALL.into_iter().filter(|&other| readings.get(other));
            assert_eq!(on.collect::<Vec<_>>(), [reading]);
            let text = toml::to_string(&readings).unwrap();
            assert!(text.contains(&format!("{} = true", reading.name())), "{text}");
            assert_eq!(Readings::PAPER.get(reading), reading.spec().paper);
            assert_eq!(Readings::REFINED.get(reading), reading.spec().refined);
        }
        let error = Reading::from_name("holes").unwrap_err();
        assert_eq!(error.to_string(), "\"holes\" is the name of no reading");
    }

    #[test]
    fn every_row_quotes_a_sentence_and_tells_both_consequences() {
        for reading in Reading::ALL {
            let spec = reading.spec();
            for text in [spec.on, spec.off] {
                assert!(text.ends_with('.') && text.len() > 30, "{}: {text}", spec.name);
            }
            assert!(spec.text.len() > 60 && spec.measured.len() > 30, "{}", spec.name);
            assert!(spec.explanation().contains(spec.text));
        }
    }
}
