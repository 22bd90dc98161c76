//! The same input gives the same bytes with any number of threads.

use crate::common::{METHODS, analyze, any_readings, fingerprint, report};
use crate::synthetic::Scene;
use dichroscope::params::{PaperMethod, Params};
use dichroscope::photo::LinearImage;
use proptest::prelude::*;

/// Whether one thread and four make the same pictures and the same report.
fn agree(image: &LinearImage, params: &Params) -> [bool; 2] {
    let [alone, together] = [1, 4].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let analysis = pool.install(|| analyze(image, params));
        (fingerprint(&analysis), report(&analysis, params).to_json().unwrap())
    });
    [alone.0 == together.0, alone.1 == together.1]
}

#[test]
fn one_thread_and_four_find_the_same() {
    for seed in [3, 4] {
        let image = Scene::grid_of_balls([240, 160], 3, 2, seed).render().image;
        for method in METHODS {
            let [pictures, reports] = agree(&image, &Params::of(method));
            assert!(pictures, "seed {seed}, {method:?}: pictures differ");
            assert!(reports, "seed {seed}, {method:?}: reports differ");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn one_thread_and_four_find_the_same_with_any_readings(seed in 0u64..1000, readings in any_readings()) {
        let image = Scene::grid_of_balls([120, 80], 2, 1, seed).render().image;
        let paper = PaperMethod { readings, ..PaperMethod::default() };
        prop_assert_eq!(agree(&image, &Params { paper, ..Params::paper() }), [true, true]);
    }
}
