//! The same input gives the same bytes with any number of threads.

use crate::common::{METHODS, analyze, fingerprint, report};
use crate::synthetic::Scene;
use dichroscope::params::{Params, Reading};

#[test]
fn one_thread_and_four_find_the_same() {
    for seed in [3, 4] {
        let image = Scene::grid_of_balls([240, 160], 3, 2, seed).render().image;
        let read_otherwise = |keep: usize| {
            let mut params = Params::paper();
            for (index, reading) in Reading::ALL.into_iter().enumerate() {
                params.paper.readings.set(reading, reading.spec().paper == (index % 2 == keep));
            }
            params
        };
        for params in METHODS.map(Params::of).into_iter().chain([0, 1].map(read_otherwise)) {
            let method = params.method;
            let [alone, together] = [1, 4].map(|threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let analysis = pool.install(|| analyze(&image, &params));
                (fingerprint(&analysis), report(&analysis, &params).to_json().unwrap())
            });
            assert!(alone.0 == together.0, "seed {seed}, {method:?}: pictures differ");
            assert_eq!(alone.1, together.1, "seed {seed}, {method:?}");
        }
    }
}
