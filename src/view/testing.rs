//! Small pictures and results for tests.

use super::{Histogram, Origin, Picture, ResultSnapshot};
use crate::analysis::{Analysis, Session};
use crate::color::{Line, Vec3};
use crate::intrinsic::{Intrinsic, RegionReflection, RegionVerdict};
use crate::params::Params;
use crate::photo::{self, EncodingChoice, ReadOptions};
use crate::raster::{HypothesisId, LabelMap, Raster, RegionId};
use crate::segment::FinalRegions;
use crate::trace::{CandidateSource, CandidateTested, CandidateVerdict, Measured};
use std::sync::{Arc, OnceLock};

/// A picture `width` pixels wide, of linear 8-bit colors.
pub(crate) fn picture(width: usize, colors: &[[u8; 3]]) -> Arc<Picture> {
    let mut bytes = format!("P6 {width} {} 255\n", colors.len() / width).into_bytes();
    bytes.extend(colors.as_flattened());
    let options = ReadOptions { encoding: EncodingChoice::Linear, ..ReadOptions::default() };
    let photo = photo::decode(&bytes, "made.ppm", &options).unwrap();
    let origin = Origin::Bytes { name: "made.ppm".into(), bytes: bytes.as_slice().into() };
    let histogram = Histogram::of(&photo.image);
    Arc::new(Picture {
        origin,
        reading: options,
        photo,
        sha256: photo::sha256_hex(&bytes),
        read_ms: 0.0,
        histogram,
        truth: None,
    })
}

/// A matte line along red, 200 counts long, and a highlight 4 counts beside it at 150, along blue.
pub(crate) fn candidate() -> CandidateTested {
    CandidateTested {
        with_distorted: false,
        hypothesis: HypothesisId::from_index(0),
        candidate: CandidateSource::Hypothesis(HypothesisId::from_index(1)),
        pixels: 40,
        matte: Line::new(Vec3::new(90.0, 3.0, 0.0), Vec3::x()),
        matte_length: 200.0,
        line: Line::new(Vec3::new(150.0, 7.0, 30.0), Vec3::z()),
        meeting: [Vec3::new(150.0, 3.0, 0.0), Vec3::new(150.0, 7.0, 0.0)],
        gap: Measured::new(4.0, 10.0),
        position_percent: 75.0,
        position_limits: [50.0, 120.0],
        angle_deg: Measured::new(90.0, 10.0),
        verdict: CandidateVerdict {
            lines_meet: true,
            upper_half: true,
            not_parallel: true,
            by_gershon: false,
            is_marked: false,
            positive: true,
            beyond: true,
        },
        weight: 40.0,
    }
}

/// A gray picture of the size of `rows`.
pub(crate) fn gray(rows: &[&str], value: u8) -> Arc<Picture> {
    picture(rows[0].len(), &vec![[value; 3]; rows[0].len() * rows.len()])
}

/// Labels drawn as digits, `.` = 0.
pub(crate) fn labels(rows: &[&str]) -> LabelMap {
    let digit = |b: u8| if b == b'.' { 0 } else { u16::from(b - b'0') };
    Raster::from_vec(rows[0].len(), rows.len(), rows.iter().flat_map(|row| row.bytes().map(digit)).collect())
        .unwrap()
}

/// The small scene of the assets.
pub(crate) fn tiny_picture() -> Arc<Picture> {
    static PICTURE: OnceLock<Arc<Picture>> = OnceLock::new();
    let read = || {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");
        let bytes = std::fs::read(path).unwrap();
        let reading = ReadOptions::default();
        let photo = photo::decode(&bytes, "camera8.png", &reading).unwrap();
        let histogram = Histogram::of(&photo.image);
        let sha256 = photo::sha256_hex(&bytes);
        Arc::new(Picture {
            origin: Origin::File(path.into()),
            reading,
            photo,
            sha256,
            read_ms: 0.0,
            histogram,
            truth: None,
        })
    };
    Arc::clone(PICTURE.get_or_init(read))
}

/// What the default method finds in the small scene, with its trace.
pub(crate) fn tiny() -> Arc<ResultSnapshot> {
    static SNAPSHOT: OnceLock<Arc<ResultSnapshot>> = OnceLock::new();
    let analyze = || {
        let (picture, params) = (tiny_picture(), Params::default());
        let image = Arc::clone(&picture.photo.image);
        let (analysis, trace) = Session::new(image).run_traced(&params, &mut ()).unwrap();
        let snapshot = snapshot(&picture, &params, analysis);
        snapshot.trace.get_or_init(|| Arc::new(trace));
        Arc::new(snapshot)
    };
    Arc::clone(SNAPSHOT.get_or_init(analyze))
}

/// What an analysis of `picture` finds.
pub(crate) fn shown(picture: &Arc<Picture>) -> ResultSnapshot {
    let params = Params::paper();
    let image = Arc::clone(&picture.photo.image);
    let analysis = Session::new(image).run(&params, &mut ()).unwrap();
    snapshot(picture, &params, analysis)
}

fn snapshot(picture: &Arc<Picture>, params: &Params, analysis: Analysis) -> ResultSnapshot {
    let count = analysis.intrinsic.regions.len();
    let region_colors = (0..count).map(|id| [id as u8; 3]).collect();
    let shown = ResultSnapshot::new(Arc::clone(picture), *params, analysis, region_colors);
    ResultSnapshot { generation: 1, ..shown }
}

/// A result with these final regions, in colors 10·id, whose body is the photograph.
pub(crate) fn divided(picture: &Arc<Picture>, rows: &[&str]) -> ResultSnapshot {
    let mut shown = shown(picture);
    let labels = labels(rows);
    let last = labels.as_slice().iter().copied().max().unwrap_or(0);
    let pixels = |id: RegionId| labels.as_slice().iter().filter(|&&label| label == id.get()).count();
    let regions = RegionId::all(usize::from(last)).map(|id| region(id, pixels(id))).collect();
    shown.region_colors = (1..=last).map(|id| [10 * id as u8; 3]).collect();
    shown.analysis.intrinsic = Arc::new(Intrinsic { regions, ..Intrinsic::clone(&shown.analysis.intrinsic) });
    let finals = FinalRegions { labels, ..FinalRegions::clone(&shown.analysis.finals) };
    shown.analysis.finals = Arc::new(finals);
    shown
}

/// A gray region under red light.
pub(crate) fn region(id: RegionId, pixels: usize) -> RegionReflection {
    RegionReflection {
        id,
        pixels,
        matte_pixels: pixels,
        highlight_pixels: 0,
        clipped_pixels: 0,
        body: [3f64.sqrt().recip(); 3],
        surface: Some([1.0, 0.0, 0.0]),
        matte_mean: [100.0; 3],
        highlight_start: None,
        highlight_branches: Vec::new(),
        plane_normal: None,
        angle_deg: None,
        fit_rms_counts: 1.5,
        fit_sigma_counts: 1.25,
        fit_limit_counts: 1.9,
        verdict: RegionVerdict::Fits,
        confidence: 1.0,
        texture: 0.0,
        separable: true,
        neighbors: Vec::new(),
        warnings: Vec::new(),
    }
}
