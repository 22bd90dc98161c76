//! What is doubtful about the split of a region, as data: `describe` has the sentences.

/// A doubt about the split of one region. Distances are in counts.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RegionWarning {
    /// The region has no dichromatic plane.
    NoPlane {
        /// Whether its pixels keep their colors; where not, everything counts as body reflection.
        keeps_color: bool,
    },
    /// The angle between body and surface vector is small.
    Angle(AngleWarning),
    /// The pixels lie farther from the plane or the matte line than noise explains.
    PoorFit {
        /// Whether the distance is that from the plane; where not, it is that from the matte line.
        has_plane: bool,
        /// Root mean square distance.
        rms_counts: f64,
        /// Largest distance that noise explains.
        limit_counts: f64,
    },
    /// Surface and body reflection vary against each other, as in a print.
    Texture {
        /// Their anticorrelation; above 1 by the error of its estimate.
        anticorrelation: f64,
    },
    /// The body vector is that of the light, as far as the light is known.
    ColorOfLight {
        /// Interval of the light as a share of the angle between body and surface vector.
        light_share: f64,
    },
    /// The split would make new edges at the region's border: the region is a part of an object.
    NewEdges {
        /// Share of the border, 0…1.
        share: f64,
    },
    /// What the plane takes for surface reflection is probably no highlight.
    NoHighlights {
        /// Mean probability of a highlight, 0…1.
        probability: f64,
    },
    /// The model does not hold, and the plane is not used.
    ModelFails {
        /// Whether the local split divides the pixels; where not, nothing does.
        is_split_locally: bool,
    },
    /// The matte line misses black: ambient light, inter-reflection or no single material.
    OffBlack {
        /// Distance of the line from black.
        counts: f64,
    },
    /// Pixels are clipped in every band, and their split is a guess.
    Clipped {
        /// Number of these pixels.
        pixels: usize,
    },
    /// Highlights lie on different amounts of body reflection (7.4).
    SeveralHighlights {
        /// The amounts, at least two, the strongest highlight first.
        bodies_counts: Vec<f32>,
    },
}

/// A doubt about the split of a region whose body and surface vector are `angle_deg` degrees apart.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum AngleWarning {
    /// Everything counts as body reflection.
    Collinear {
        /// Angle between both vectors.
        angle_deg: f64,
    },
    /// The split amplifies noise.
    Noise {
        /// Angle between both vectors.
        angle_deg: f64,
    },
    /// The highlight cluster does not leave the matte cylinder, and the region is not split (7.5, reading `angle_by_width`).
    InCylinder {
        /// Angle between both vectors.
        angle_deg: f64,
        /// Length of the highlight cluster, counts.
        extent_counts: f64,
        /// Angle at which a cluster of this length leaves the cylinder, degrees.
        least_deg: f64,
    },
    /// At least half of the highlight cluster lies in the matte cylinder (7.5, reading `angle_by_width`).
    HalfInCylinder {
        /// Angle between both vectors.
        angle_deg: f64,
        /// Length of the highlight cluster, counts.
        extent_counts: f64,
    },
}
