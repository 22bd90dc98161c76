//! A record of all decisions, played from the empty picture, ends in the result; and recording changes nothing.

use crate::common::{analyze, fingerprint};
use crate::synthetic::Scene;
use dichroscope::analysis::Session;
use dichroscope::segment::{Method, Params, Setting};
use dichroscope::trace::{Entry, Event, Log, Stage};
use proptest::prelude::*;
use std::sync::Arc;

fn random_params() -> impl Strategy<Value = Params> {
    let numbers = (4u32..14, 1f64..8.0, 1f64..8.0, 60u32..800, 1f64..6.0);
    let method = prop_oneof![Just(Method::Refined), Just(Method::Paper)];
    (method, any::<bool>(), numbers).prop_map(|(method, default, (window, cylinder, slice, area, noise))| {
        if default {
            return Params::of(method);
        }
        Params {
            window_size: Setting::Value(f64::from(window)),
            cylinder_width: Setting::Value(cylinder),
            slice_width: Setting::Value(slice),
            min_area: Setting::Value(f64::from(area)),
            camera_noise: Setting::Value(noise),
            ..Params::of(method)
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn a_replayed_record_is_the_result(seed in any::<u64>(), params in random_params()) {
        let image = Scene::grid_of_balls([140, 70], 2, 1, seed).render().image;
        let mut log = Log::default();
        let recorded =
            Session::new(Arc::new(image.clone())).run_recorded(&params, &mut (), &mut log).unwrap();
        let replayed = log.replay(image.width(), image.height());
        let replayed = replayed.map_err(|entry| {
            TestCaseError::fail(format!("entry {entry} contradicts the record: {:?}", log.entries[entry]))
        })?;
        prop_assert!(replayed.labels == recorded.finals.labels, "regions differ");
        prop_assert!(replayed.kinds == recorded.intrinsic.kinds, "kinds differ");
        prop_assert!(fingerprint(&recorded) == fingerprint(&analyze(&image, &params)), "recording changes the result");
    }
}

#[test]
fn every_stage_announces_itself_once_and_in_order() {
    let image = Scene::grid_of_balls([140, 70], 2, 1, 5).render().image;
    let mut log = Log::default();
    let mut session = Session::new(Arc::new(image));
    session.run(&Params::default(), &mut ()).unwrap();
    session.run_recorded(&Params::default(), &mut (), &mut log).unwrap();
    let begun: Vec<Stage> = log
        .entries
        .iter()
        .filter_map(|entry| match entry {
            Entry::Event(Event::StageBegan { stage }) => Some(*stage),
            _ => None,
        })
        .collect();
    assert_eq!(begun, Stage::ALL, "a record holds every stage, though the session had run before");
}
