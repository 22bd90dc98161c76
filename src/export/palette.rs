//! Colors by which regions can be distinguished, with normal vision and with red-green color blindness.
//!
//! Hues are spread evenly in OKLCH (Ottosson 2020) on three levels of lightness, because lightness distinguishes colors whose
//! hues a reader cannot distinguish. The distance of two colors is the smallest of their `OKLab` distances with normal vision,
//! with protanopia and with deuteranopia (Viénot, Brettel & Mollon 1999).

use super::png::code_from_linear;

/// Levels of lightness, close together, so that no region stands out or vanishes by its color, and each bright enough for a
/// contrast of 4.5 on the window's dark panels. Each has a chroma at which every hue lies inside sRGB; a test checks this.
const LEVELS: [(f32, f32); 3] = [(0.74, 0.12), (0.64, 0.105), (0.84, 0.075)];
const HUES: usize = 8;
/// Order of the hues: distant hues first, so that a picture of few regions uses the whole circle.
const HUE_ORDER: [u8; HUES] = [0, 4, 2, 6, 1, 5, 3, 7];
const COLORS: usize = LEVELS.len() * HUES;
/// `OKLab` distance from which on two colors are easily distinguished; among such colors the first is preferred.
const EASY_DISTANCE: f32 = 0.12;
/// `OKLab` distance that neighbors have at least, as long as there is such a color. A color that no other label has is preferred to one
/// at a larger distance.
const LEAST_DISTANCE: f32 = 0.06;

/// Matrices from linear sRGB to linear sRGB as seen with protanopia and with deuteranopia.
const CONE_DEFICITS: [[[f32; 3]; 3]; 2] = [
    [[0.112_38, 0.887_62, 0.0], [0.112_38, 0.887_62, 0.0], [0.004_01, -0.004_01, 1.0]],
    [[0.292_75, 0.707_25, 0.0], [0.292_75, 0.707_25, 0.0], [-0.022_34, 0.022_34, 1.0]],
];

/// The colors and the distances between them.
pub struct Palette {
    colors: [[u8; 3]; COLORS],
    distances: [[f32; COLORS]; COLORS],
}

impl Default for Palette {
    fn default() -> Self {
        Self::new()
    }
}

impl Palette {
    /// Computes the colors and their distances.
    pub fn new() -> Self {
        let linear: [[f32; 3]; COLORS] = std::array::from_fn(|i| {
            // The numbers of hues and levels have no common divisor, so that every hue occurs on every level.
            let level = i % LEVELS.len();
            let (lightness, chroma) = LEVELS[level];
            // The hues of a level lie between the hues of the other levels.
            let hue = HUE_ORDER[i % HUES] as f32 + level as f32 / LEVELS.len() as f32;
            linear_srgb_from_oklch(lightness, chroma, std::f32::consts::TAU * hue / HUES as f32)
        });
        let perceived = linear.map(perceived);
        let distance = |a: usize, b: usize| {
            (0..3).map(|eye| euclidean(perceived[a][eye], perceived[b][eye])).fold(f32::INFINITY, f32::min)
        };
        Self {
            colors: linear.map(|color| color.map(code_from_linear)),
            distances: std::array::from_fn(|a| std::array::from_fn(|b| distance(a, b))),
        }
    }

    /// All colors as 8-bit sRGB.
    pub fn colors(&self) -> &[[u8; 3]] {
        &self.colors
    }

    /// The color at `index` as 8-bit sRGB.
    pub fn color(&self, index: u8) -> [u8; 3] {
        self.colors[usize::from(index)]
    }

    /// Index of an 8-bit sRGB color; none for a color that is not in the palette.
    pub fn index_of(&self, color: [u8; 3]) -> Option<u8> {
        self.colors.iter().position(|known| *known == color).map(|index| index as u8)
    }

    /// The index of a color for each label, chosen label by label: of the colors that differ from those of the label's neighbors the
    /// least used, and of these the one farthest from the neighbors' colors. `neighbors`: the labels adjacent to each label.
    pub fn assign(&self, neighbors: &[Vec<u32>]) -> Vec<u8> {
        self.assign_keeping(neighbors, &[])
    }

    /// As [`Self::assign`], but labels with an index in `kept` keep that color, and their neighbors get distant colors.
    pub fn assign_keeping(&self, neighbors: &[Vec<u32>], kept: &[Option<u8>]) -> Vec<u8> {
        let kept = |label: usize| kept.get(label).copied().flatten();
        let mut chosen: Vec<u8> = (0..neighbors.len()).map(|label| kept(label).unwrap_or(0)).collect();
        let mut uses = [0usize; COLORS];
        for index in (1..neighbors.len()).filter_map(kept) {
            uses[usize::from(index)] += 1;
        }
        for label in (1..neighbors.len()).filter(|&label| kept(label).is_none()) {
            let settled = |other: usize| other < label || kept(other).is_some();
            let mut clearance = [EASY_DISTANCE; COLORS];
            for &other in neighbors[label].iter().filter(|&&other| settled(other as usize)) {
                let taken = &self.distances[usize::from(chosen[other as usize])];
                for (clearance, distance) in clearance.iter_mut().zip(taken) {
                    *clearance = clearance.min(*distance);
                }
            }
            let better = |&a: &usize, &b: &usize| {
                let differs = |color: usize| clearance[color] >= LEAST_DISTANCE;
                let by_clearance = clearance[a].total_cmp(&clearance[b]);
                differs(a).cmp(&differs(b)).then(uses[b].cmp(&uses[a])).then(by_clearance).then(b.cmp(&a))
            };
            let best = (0..COLORS).max_by(better).unwrap_or(0);
            uses[best] += 1;
            chosen[label] = best as u8;
        }
        chosen
    }
}

/// `OKLab` coordinates with normal vision, protanopia and deuteranopia.
fn perceived(linear: [f32; 3]) -> [[f32; 3]; 3] {
    let [protan, deutan] = CONE_DEFICITS.map(|m| oklab_from_linear_srgb(apply(&m, linear)));
    [oklab_from_linear_srgb(linear), protan, deutan]
}

fn linear_srgb_from_oklch(lightness: f32, chroma: f32, hue_rad: f32) -> [f32; 3] {
    let lab = [lightness, chroma * hue_rad.cos(), chroma * hue_rad.sin()];
    let roots = apply(
        &[
            [1.0, 0.396_337_78, 0.215_803_76],
            [1.0, -0.105_561_346, -0.063_854_17],
            [1.0, -0.089_484_18, -1.291_485_5],
        ],
        lab,
    );
    apply(
        &[
            [4.076_741_7, -3.307_711_6, 0.230_969_94],
            [-1.268_438, 2.609_757_4, -0.341_319_38],
            [-0.004_196_086_3, -0.703_418_6, 1.707_614_7],
        ],
        roots.map(|root| root.powi(3)),
    )
}

fn oklab_from_linear_srgb(linear: [f32; 3]) -> [f32; 3] {
    let cones = apply(
        &[
            [0.412_221_46, 0.536_332_55, 0.051_445_995],
            [0.211_903_5, 0.680_699_5, 0.107_396_96],
            [0.088_302_46, 0.281_718_85, 0.629_978_7],
        ],
        linear,
    );
    apply(
        &[
            [0.210_454_26, 0.793_617_8, -0.004_072_047],
            [1.977_998_5, -2.428_592_2, 0.450_593_7],
            [0.025_904_037, 0.782_771_77, -0.808_675_77],
        ],
        cones.map(f32::cbrt),
    )
}

fn apply(matrix: &[[f32; 3]; 3], v: [f32; 3]) -> [f32; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

fn euclidean(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f32>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn oklab_there_and_back() {
        let linear = linear_srgb_from_oklch(0.7, 0.08, 1.1);
        let lab = oklab_from_linear_srgb(linear);
        assert!(euclidean(lab, [0.7, 0.08 * 1.1f32.cos(), 0.08 * 1.1f32.sin()]) < 1e-4);
        assert!(euclidean(oklab_from_linear_srgb([1.0; 3]), [1.0, 0.0, 0.0]) < 1e-3, "white has no hue");
    }

    #[test]
    fn every_color_lies_inside_srgb() {
        for (lightness, chroma) in LEVELS {
            for step in 0..360 {
                let color = linear_srgb_from_oklch(lightness, chroma, (step as f32).to_radians());
                assert!(
                    color.iter().all(|v| (-0.002..=1.002).contains(v)),
                    "L {lightness} C {chroma} h {step}\u{b0}: {color:?}"
                );
            }
        }
    }

    #[test]
    fn neighbors_are_distinguishable_with_normal_vision_and_color_blindness() {
        // Four labels that all touch each other (the most that is possible in a plane), and one that touches three of these.
        let mut neighbors = vec![Vec::new(); 6];
        for a in 1..=4u32 {
            neighbors[a as usize] = (1..=4).filter(|&b| b != a).collect();
        }
        neighbors[5] = vec![1, 2, 3];
        let palette = Palette::new();
        let colors = palette.assign(&neighbors);
        for (label, list) in neighbors.iter().enumerate() {
            for &other in list {
                let (a, b) = (usize::from(colors[label]), usize::from(colors[other as usize]));
                assert!(palette.distances[a][b] >= 0.1, "{label} and {other}: {}", palette.distances[a][b]);
            }
        }
    }

    #[test]
    fn kept_colors_stay_and_their_neighbors_get_distant_colors() {
        let palette = Palette::new();
        let neighbors = [vec![], vec![2, 3], vec![1, 3], vec![1, 2], vec![]];
        let colors = palette.assign_keeping(&neighbors, &[None, None, None, Some(7), None]);
        assert_eq!(colors[3], 7);
        for (a, b) in [(1, 2), (1, 3), (2, 3)] {
            assert!(palette.distances[usize::from(colors[a])][usize::from(colors[b])] >= 0.1);
        }
        assert_ne!(colors[4], 7, "the rarest");
        assert!((0..COLORS as u8).all(|index| palette.index_of(palette.color(index)) == Some(index)));
        assert_eq!(palette.index_of([1, 2, 3]), None);
    }

    #[test]
    fn labels_around_a_large_one_have_colors_of_their_own() {
        // A background that touches all of twelve objects, and objects in a row that touch one another.
        let mut neighbors = vec![vec![], (2..=13).collect()];
        neighbors.extend((2..=13u32).map(|label| vec![1, label - 1, label + 1]));
        neighbors[2] = vec![1, 3];
        neighbors[13] = vec![1, 12];
        let palette = Palette::new();
        let colors = palette.assign(&neighbors).split_off(1);
        let mut distinct = colors.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), colors.len());
        for (label, list) in neighbors.iter().enumerate().skip(1) {
            for &other in list {
                let (a, b) = (usize::from(colors[label - 1]), usize::from(colors[other as usize - 1]));
                assert!(palette.distances[a][b] >= LEAST_DISTANCE, "{label} and {other}");
            }
        }
    }

    #[test]
    fn labels_that_touch_nothing_use_the_whole_palette() {
        let mut colors = Palette::new().assign(&vec![Vec::new(); COLORS + 1]).split_off(1);
        colors.sort_unstable();
        assert_eq!(colors, (0..COLORS as u8).collect::<Vec<_>>());
    }
}
