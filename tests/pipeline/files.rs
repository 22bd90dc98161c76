//! The result files hold the values of the analysis.

use crate::common::analyze;
use crate::synthetic::Scene;
use dichroscope::export::write_pictures;
use dichroscope::params::Params;
use dichroscope::truth::ResultPictures;
use exr::prelude::read_first_rgba_layer_from_file;
use std::path::Path;
use std::sync::Arc;

/// The colors of an EXR file, counts, row-major.
fn exr_counts(path: &Path) -> Vec<[f32; 3]> {
    let picture = read_first_rgba_layer_from_file(
        path,
        |size, _| (size.width(), vec![[0f32; 3]; size.width() * size.height()]),
        |(width, counts), at, (r, g, b, _): (f32, f32, f32, f32)| {
            counts[at.y() * *width + at.x()] = [r, g, b].map(|unit| unit * 255.0);
        },
    );
    picture.unwrap().layer_data.channel_data.pixels.1
}

#[test]
fn pictures_read_back_as_they_were_and_body_and_surface_and_residual_are_the_input() {
    let image = Scene::grid_of_balls([160, 80], 2, 1, 30).render().image;
    let analysis = analyze(&image, &Params::default());
    let folder = tempfile::tempdir().unwrap();
    write_pictures(folder.path(), &image, &analysis).unwrap();
    let read = ResultPictures::read(folder.path()).unwrap();
    assert_eq!(read.regions, analysis.finals.labels);
    let residual = exr_counts(&folder.path().join("residual.exr"));
    assert_eq!(residual.len(), image.pixels.len());
    let close = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3);
    for (pixel, rest) in residual.into_iter().enumerate() {
        let (body, surface) = (read.body[pixel], read.surface[pixel]);
        assert!(
            close(body, analysis.intrinsic.body[pixel]) && close(surface, analysis.intrinsic.surface[pixel])
        );
        let sum = std::array::from_fn(|band| body[band] + surface[band] + rest[band]);
        assert!(close(sum, image.pixels[pixel]), "{sum:?} of {:?}", image.pixels[pixel]);
    }
}

#[test]
fn more_than_255_regions_keep_their_numbers() {
    let image = Scene::one_ball([40, 30], [0.2, 0.9, 0.3]).render().image;
    let mut analysis = analyze(&image, &Params::default());
    let finals = Arc::make_mut(&mut analysis.finals);
    finals.labels = finals.labels.map(|&label| label * 300);
    let folder = tempfile::tempdir().unwrap();
    write_pictures(folder.path(), &image, &analysis).unwrap();
    assert_eq!(ResultPictures::read(folder.path()).unwrap().regions, analysis.finals.labels);
    assert!(analysis.finals.labels.as_slice().contains(&300), "the ball was found");
}
