//! The same input gives the same bytes with any number of threads.

use crate::common::{METHODS, analyze, fingerprint, report};
use crate::synthetic::Scene;
use dichroscope::params::Params;

#[test]
fn one_thread_and_four_find_the_same() {
    for seed in [3, 4] {
        let image = Scene::grid_of_balls([240, 160], 3, 2, seed).render().image;
        for method in METHODS {
            let params = Params::of(method);
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
