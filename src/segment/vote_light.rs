//! The light by the votes of small highlights, without regions (beyond the paper; refinement `vote_light`).
//!
//! Let G1 and G3 be Gaussians with a standard deviation of 1 and 3 pixels. Where a highlight is small, D = G1(I) − G3(I) is the
//! color of the highlight, and so of the light, and B = G3(I) is the color of the body under the highlight: the light lies in
//! the plane of D and B. Voters are unclipped pixels with D and B positive in every band, ΣD above max(98 % quantile of the lit
//! pixels, 8σ), and more than 2° between D and B; fewer than 30 voters give no vote. The plane of a voter has the unit normal
//! n = D × B, and the voter has the weight min(1, 60 / pixels of its blob). The votes for a light s are
//!
//! H(s) = Σ w·exp(−e²/2v)/√v · exp(−δ²/2τ²): e is the angle of s from the plane, v = 1 + (σ/2 / (|D| sin∠))² degrees², and δ the
//! angle within the plane from D to s, positive away from B. τ = 8° for positive δ and 3° for negative δ, because D still
//! contains some body reflection.
//!
//! The prior is white, with a standard deviation of 14° between blue and yellow and 6° between green and magenta. Without the
//! prior, white paper beside blue votes for yellow lights (13 dB worse on the picture with such paper). The elected light has an
//! error within 1° on most of 36 scenes with highlights, where the planes of printed objects are 8–18° off; on plain objects
//! the planes are better (0.1°).

use super::illuminant::{LEAST_BAND, unusualness, white_offsets_deg};
use super::input::AnalysisInput;
use crate::color::{Vec3, dot, rgb, vec3};
use crate::raster::{Components, Connectivity, Mask, Raster, Roi, blur, dilate};
use crate::trace::VoteResult;
use rayon::prelude::*;

/// Standard deviations of the two Gaussians, pixels.
const FINE_PX: f64 = 1.0;
const COARSE_PX: f64 = 3.0;
/// Radius by which the mask of clipped pixels is dilated, pixels.
const CLIP_MARGIN_PX: usize = 2;
/// Share of the lit pixels that cannot vote because their ΣD is too small.
const QUANTILE: f64 = 0.98;
/// Least ΣD of a voter, σ.
const LEAST_RISE: f32 = 8.0;
/// Least angle between D and B, degrees.
const LEAST_ANGLE_DEG: f64 = 2.0;
/// Fewest voters of a vote.
pub const LEAST_VOTERS: usize = 30;
/// Largest number of voters that are used, evenly chosen.
const MOST_VOTERS: usize = 1500;
/// Number of pixels of a blob above which the weight of each pixel is below 1.
const BLOB_PX: f64 = 60.0;
/// τ for positive δ, degrees.
const BEYOND_DEG: f64 = 8.0;
/// τ for negative δ, degrees.
const BEFORE_DEG: f64 = 3.0;
/// Half opening angle of the cone of lights around white that are tried, degrees.
const CONE_DEG: f64 = 32.0;
/// Steps of the successive searches, degrees.
const STEPS_DEG: [f64; 4] = [2.0, 1.0, 0.5, 0.25];
/// A vote below e to the power of minus this counts as 0.
const NEGLIGIBLE: f64 = 8.0;
/// The first, coarse search uses one of this many voters.
const FIRST_SEARCH_STEP: usize = 3;
/// Measured product of the elected light's error (degrees) and its share of the votes: 0.8° at 6 %, 3° at 4 %, 6° at 3 %.
const MISS_DEG: f64 = 0.1;
/// Angle from a light within which a pixel has the color of the light, degrees.
const BODY_DEG: f64 = 6.0;
/// Largest number of pixels whose color is compared with the light.
const MOST_COMPARED: usize = 50_000;
/// Number of parts of the blobs for the jackknife: each part is left out once.
const PARTS: usize = 8;

/// The vote of one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Voter {
    /// Unit normal of the plane of D and B.
    normal: Vec3,
    /// Unit vector along D.
    rise: Vec3,
    /// Unit vector in the plane, perpendicular to D, away from B.
    beyond: Vec3,
    /// v, degrees².
    variance_deg2: f64,
    /// Sine of the angle between light and plane above which the light gets no vote.
    reach: f64,
    /// w: 1, or less in a large blob.
    weight: f64,
    /// Number of the voter's blob, from 0.
    blob: usize,
}

/// The votes of all voters of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Votes {
    voters: Vec<Voter>,
    /// Number of small highlights (blobs) that the voters belong to.
    pub blobs: usize,
    /// Sum of the voters' weights.
    total: f64,
}

/// The light that the votes elect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoteLight {
    /// Direction, share of the votes, and how unusual the light is.
    pub result: VoteResult,
    /// Angle within which the light lies, by the votes alone, degrees.
    pub interval_deg: f64,
}

/// The votes of a picture and the light that they elect. Both depend on the picture and its masks alone, and not on regions.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureVotes {
    /// All votes.
    pub(super) votes: Votes,
    /// The elected light.
    pub(super) light: VoteLight,
}

impl PictureVotes {
    /// Whether the planar stage asks for votes: `vote_light` is on, and no light is given.
    pub fn are_asked(input: &AnalysisInput) -> bool {
        input.refine.vote_light && input.used.illuminant.is_none()
    }

    /// The votes of the picture `input`; `None` where there are fewer than `LEAST_VOTERS` voters.
    pub fn of(input: &AnalysisInput) -> Option<Self> {
        let votes = Votes::cast(input)?;
        let light = votes.elect(input);
        Some(Self { votes, light })
    }
}

/// Share of the lit pixels, evenly chosen, whose color is within [`BODY_DEG`] of `color`, unit.
fn share_of_color(input: &AnalysisInput, color: &Vec3) -> f64 {
    let step = input.pixels.len().div_ceil(MOST_COMPARED).max(1);
    let (least_cosine, color) = (BODY_DEG.to_radians().cos(), rgb(color));
    let (mut lit, mut alike) = (0u32, 0u32);
    for pixel in (0..input.pixels.len()).step_by(step).filter(|&pixel| input.masks.usable(pixel)) {
        let found = input.pixels[pixel];
        lit += 1;
        alike += u32::from(f64::from(dot(found, color)) > least_cosine * f64::from(dot(found, found)).sqrt());
    }
    f64::from(alike) / f64::from(lit.max(1))
}

impl Votes {
    /// The elected light of the picture `input`.
    fn elect(&self, input: &AnalysisInput) -> VoteLight {
        let winner = self.winner();
        let result = VoteResult {
            direction: winner.into(),
            voters: self.voters() as u32,
            blobs: self.blobs as u32,
            share: self.share(&winner),
            offsets_deg: white_offsets_deg(&winner),
            body_share: share_of_color(input, &winner),
        };
        VoteLight { result, interval_deg: self.interval_deg(&winner) }
    }

    /// Number of voters that are used.
    pub fn voters(&self) -> usize {
        self.voters.len()
    }

    /// The votes of a picture; `None` where there are fewer than [`LEAST_VOTERS`] voters.
    fn cast(input: &AnalysisInput) -> Option<Self> {
        let size = (input.pixels.width(), input.pixels.height());
        let margin_px = (4.0 * COARSE_PX) as usize;
        let window = Roi::around(size, margin_px, |pixel| !input.masks.dark(pixel))?;
        let clipped = dilate(&input.masks.mask(crate::photo::Masks::clipped), CLIP_MARGIN_PX);
        let known = |pixel: usize| !input.masks.invalid(pixel) && !input.masks.outside(pixel);
        let valid = |pixel: usize| !clipped[pixel] && known(pixel);
        let weighted = window.raster(|pixel| {
            let [r, g, b] = input.pixels[pixel];
            if valid(pixel) { [r, g, b, 1.0] } else { [0.0; 4] }
        });
        let coarse = blur(&weighted, COARSE_PX);
        let fine = blur(&weighted, FINE_PX);
        let lit = |index: usize| {
            let pixel = window.pixel(index);
            !input.masks.dark(pixel) && valid(pixel)
        };
        let (fine, coarse) = (fine.as_slice(), coarse.as_slice());
        let rise = |index: usize| {
            let (fine, coarse) = (normalized(fine[index]), normalized(coarse[index]));
            std::array::from_fn::<f32, 3, _>(|band| fine[band] - coarse[band])
        };
        let sums: Vec<f32> = (0..window.len())
            .into_par_iter()
            .with_min_len(1 << 12)
            .map(|index| if lit(index) { rise(index).iter().sum() } else { f32::NEG_INFINITY })
            .collect();
        let least = least_rise(&sums)?.max(LEAST_RISE * input.sigma() as f32);
        let votes = |index: usize| {
            let (d, b) = (rise(index), normalized(coarse[index]));
            (d.iter().chain(&b).all(|band| *band > 0.0)).then(|| Voter::new(d, b, input.sigma())).flatten()
        };
        let found: Vec<(usize, Voter)> = (0..window.len())
            .into_par_iter()
            .with_min_len(1 << 12)
            .filter(|&index| sums[index] > least)
            .filter_map(|index| Some((index, votes(index)?)))
            .collect();
        Self::counted(&found, window.width, window.height)
    }

    /// Weights the voters (each with its pixel) by the sizes of their blobs, and chooses at most [`MOST_VOTERS`] of them.
    fn counted(found: &[(usize, Voter)], width: usize, height: usize) -> Option<Self> {
        if found.len() < LEAST_VOTERS {
            return None;
        }
        let mut mask: Mask = Raster::filled(width, height, false);
        for &(index, _) in found {
            mask[index] = true;
        }
        let blobs = Components::of_mask(&mask, Connectivity::Eight);
        let step = found.len().div_ceil(MOST_VOTERS);
        let voters: Vec<Voter> = found
            .iter()
            .step_by(step)
            .map(|&(pixel, voter)| {
                let blob = blobs.of[pixel] as usize;
                Voter { weight: (BLOB_PX / blobs.sizes[blob] as f64).min(1.0), blob, ..voter }
            })
            .collect();
        let total = voters.iter().map(|voter| voter.weight).sum();
        Some(Self { voters, blobs: blobs.sizes.len(), total })
    }

    /// H(s) of the light `light` as a share of the sum of all weights, 0…1.
    pub fn share(&self, light: &Vec3) -> f64 {
        self.voters.iter().map(|voter| voter.votes_for(light)).sum::<f64>() / self.total.max(1e-12)
    }

    /// The light with the largest product of votes and prior.
    pub fn winner(&self) -> Vec3 {
        let mut best = Vec3::repeat(1.0).normalize();
        for (index, step_deg) in STEPS_DEG.into_iter().enumerate() {
            let reach_deg = if index == 0 { CONE_DEG } else { 3.0 * step_deg };
            // A part of the voters suffices to find the neighborhood of the maximum.
            let voter_step = if index == 0 { FIRST_SEARCH_STEP } else { 1 };
            let lights = cone(&best, reach_deg, step_deg);
            let votes = lights.par_iter().map(|light| {
                let voters = self.voters.iter().step_by(voter_step);
                voters.map(|voter| voter.votes_for(light)).sum()
            });
            best = elected(&lights, &votes.collect::<Vec<f64>>()).unwrap_or(best);
        }
        best
    }

    /// Angle within which the light lies, degrees: two standard deviations of the winner, by a jackknife over eighths of the
    /// blobs, and at least the error measured for winners with the same share of the votes.
    pub fn interval_deg(&self, winner: &Vec3) -> f64 {
        let lights = cone(winner, 3.0, 0.5);
        let by_part: Vec<[f64; PARTS]> = lights
            .par_iter()
            .map(|light| {
                let mut votes = [0.0; PARTS];
                self.voters.iter().for_each(|voter| votes[voter.blob % PARTS] += voter.votes_for(light));
                votes
            })
            .collect();
        let squares: f64 = (0..PARTS)
            .map(|part| {
                let others = by_part.iter().map(|votes| votes.iter().sum::<f64>() - votes[part]);
                let without = elected(&lights, &others.collect::<Vec<f64>>()).unwrap_or(*winner);
                crate::color::axis_angle_deg(&without, winner).powi(2)
            })
            .sum();
        let parts = PARTS as f64;
        let spread_deg = 2.0 * (squares * (parts - 1.0) / parts).sqrt();
        spread_deg.max(MISS_DEG / self.share(winner).max(1e-3)).clamp(1.0, 90.0)
    }
}

/// The light with the largest product of votes and prior; `None` without a vote.
fn elected(lights: &[Vec3], votes: &[f64]) -> Option<Vec3> {
    let merits: Vec<f64> =
        lights.iter().zip(votes).map(|(light, votes)| votes * (-unusualness(light)).exp()).collect();
    let best = (0..lights.len()).max_by(|&a, &b| merits[a].total_cmp(&merits[b]).then(b.cmp(&a)))?;
    (merits[best] > 0.0).then(|| lights[best])
}

impl Voter {
    /// The voter with the colors D and B (counts) and noise `sigma` of a band (counts); `None` where the angle between D and B
    /// is too small.
    fn new(d: [f32; 3], b: [f32; 3], sigma: f64) -> Option<Self> {
        let (d, b) = (vec3(d), vec3(b));
        let normal = d.cross(&b);
        let (rise, sine) = (d.norm(), normal.norm() / (d.norm() * b.norm()));
        let angle_deg = normal.norm().atan2(d.dot(&b)).to_degrees();
        if angle_deg.partial_cmp(&LEAST_ANGLE_DEG) != Some(std::cmp::Ordering::Greater) {
            return None;
        }
        let error_deg = (sigma / 2.0 / (rise * sine)).to_degrees();
        let (normal, rise) = (normal.try_normalize(0.0)?, d.try_normalize(0.0)?);
        let beyond = rise.cross(&normal);
        let variance_deg2 = 1.0 + error_deg * error_deg;
        let reach = (2.0 * NEGLIGIBLE * variance_deg2).sqrt().min(90.0).to_radians().sin();
        Some(Self { normal, rise, beyond, variance_deg2, reach, weight: 1.0, blob: 0 })
    }

    /// The summand of H for a light (unit direction).
    #[inline]
    fn votes_for(&self, light: &Vec3) -> f64 {
        let sine = self.normal.dot(light);
        if sine.abs() > self.reach {
            return 0.0;
        }
        let (along, beyond) = (self.rise.dot(light), self.beyond.dot(light));
        // The vote is negligible beyond four tolerances: for δ above 32° (tangent 0.625) or below −12° (tangent −0.213).
        if beyond > 0.625 * along || beyond < -0.213 * along {
            return 0.0;
        }
        let off_deg = sine.clamp(-1.0, 1.0).asin().to_degrees();
        let across_term = off_deg * off_deg / (2.0 * self.variance_deg2);
        let beyond_deg = beyond.atan2(along).to_degrees();
        let tolerance_deg = if beyond_deg >= 0.0 { BEYOND_DEG } else { BEFORE_DEG };
        let within_term = (beyond_deg / tolerance_deg).powi(2) / 2.0;
        self.weight * (-across_term - within_term).exp() / self.variance_deg2.sqrt()
    }
}

/// A weighted sum of colors divided by the sum of the weights; black where the sum of the weights is nearly 0.
#[inline]
fn normalized([r, g, b, weight]: [f32; 4]) -> [f32; 3] {
    // So small a weight means that all pixels nearby are clipped.
    if weight > 1e-3 { [r / weight, g / weight, b / weight] } else { [0.0; 3] }
}

/// The quantile [`QUANTILE`] of the finite values; `None` without one.
fn least_rise(sums: &[f32]) -> Option<f32> {
    let mut lit: Vec<f32> = sums.par_iter().copied().filter(|sum| sum.is_finite()).collect();
    let rank = (QUANTILE * lit.len() as f64) as usize;
    (rank < lit.len()).then(|| *lit.select_nth_unstable_by(rank, f32::total_cmp).1)
}

/// Unit directions within `reach_deg` of `center`, on a grid of `step_deg`, whose bands all exceed [`LEAST_BAND`].
fn cone(center: &Vec3, reach_deg: f64, step_deg: f64) -> Vec<Vec3> {
    let side = if center.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() };
    let u = center.cross(&side).normalize();
    let v = center.cross(&u);
    let steps = (reach_deg / step_deg).round() as i32;
    let mut lights = Vec::new();
    for i in -steps..=steps {
        for j in -steps..=steps {
            let (a, b) = (f64::from(i) * step_deg, f64::from(j) * step_deg);
            let reach = a.hypot(b);
            if reach > reach_deg + 1e-9 {
                continue;
            }
            let (sine, cosine) = reach.to_radians().sin_cos();
            let across = if reach > 0.0 { (u * a + v * b) / reach } else { Vec3::zeros() };
            let light = center * cosine + across * sine;
            if light.min() > LEAST_BAND {
                lights.push(light);
            }
        }
    }
    lights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::axis_angle_deg;
    use crate::segment::testing::Drawing;

    #[test]
    fn small_highlights_on_two_colors_elect_their_light() {
        let light = Vec3::new(0.65, 0.57, 0.5).normalize();
        let drawing = Drawing::by_place(60, |x, y| {
            let body = if x < 30.0 { Vec3::new(0.8, 0.3, 0.2) } else { Vec3::new(0.2, 0.5, 0.7) };
            let d2 = ((x % 30.0) - 15.0).powi(2) + ((y % 30.0) - 15.0).powi(2);
            body * (80.0 + 0.3 * y) + light * (150.0 * (-d2 / 8.0).exp())
        });
        let votes = Votes::cast(&drawing.input()).unwrap();
        let winner = votes.winner();
        assert!(axis_angle_deg(&winner, &light) < 1.5, "{winner}");
        assert!(votes.share(&winner) > 0.1 && votes.blobs == 4, "{} {}", votes.share(&winner), votes.blobs);
        assert!(votes.interval_deg(&winner) < 6.0, "{}", votes.interval_deg(&winner));
    }

    #[test]
    fn shading_alone_does_not_vote() {
        let drawing =
            Drawing::by_place(60, |x, y| Vec3::new(0.8, 0.3, 0.2) * (60.0 + x + 20.0 * (y / 9.0).sin()));
        assert_eq!(Votes::cast(&drawing.input()), None);
    }
}
