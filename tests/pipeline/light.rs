//! A given light is used for every plane and every split.

use crate::common::{METHODS, analyze, assert_valid, fingerprint, report};
use crate::synthetic::{Scene, dot};
use dichroscope::analysis::Session;
use dichroscope::params::{IlluminantSetting, Params};
use dichroscope::trace::{Event, IlluminantGiven};
use proptest::prelude::*;
use std::sync::Arc;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn every_plane_and_every_split_turns_to_a_given_light(
        seed in any::<u64>(),
        light in prop::array::uniform3(0.2f64..1.0),
        paper in any::<bool>(),
    ) {
        let image = Scene::grid_of_balls([160, 80], 2, 1, seed).render().image;
        let illuminant = IlluminantSetting::Given(light);
        let params = Params { illuminant, ..Params::of(METHODS[usize::from(paper)]) };
        let analysis = analyze(&image, &params);
        let given = illuminant.direction().unwrap();
        let found = analysis.illuminant.unwrap();
        prop_assert!(found.given && found.objects == 0 && found.direction == given);
        for hypothesis in &analysis.finals.hypotheses {
            if let Some(plane) = &hypothesis.plane {
                prop_assert!(dot(plane.surface.into(), given) > 1.0 - 1e-12);
                prop_assert!(dot(plane.normal.into(), given).abs() < 1e-9);
            }
        }
        for region in &analysis.intrinsic.regions {
            prop_assert!(region.surface.is_none_or(|surface| dot(surface, given) > 1.0 - 1e-12));
        }
        let facts = report(&analysis, &params);
        prop_assert_eq!(facts.params.illuminant.asked, illuminant);
        prop_assert_eq!(facts.params.illuminant.used, Some(given));
        prop_assert!(facts.illuminant.given);
    }
}

#[test]
fn its_length_says_nothing() {
    let image = Scene::grid_of_balls([160, 80], 2, 1, 3).render().image;
    let under = |light: [f64; 3]| {
        let illuminant = IlluminantSetting::Given(light);
        fingerprint(&analyze(&image, &Params { illuminant, ..Params::default() }))
    };
    assert!(under([1.0, 0.75, 0.5]) == under([4.0, 3.0, 2.0]));
}

#[test]
fn the_true_light_serves_as_well_as_the_estimate() {
    let scene = Scene::grid_of_balls([240, 160], 3, 2, 8);
    let image = scene.render().image;
    let illuminant = IlluminantSetting::Given(scene.illuminant);
    let estimated = analyze(&image, &Params::default());
    let given = analyze(&image, &Params { illuminant, ..Params::default() });
    assert_valid(&image, &given, "given light");
    assert_eq!(estimated.finals.hypotheses.len(), given.finals.hypotheses.len());
}

#[test]
fn the_record_says_that_it_was_given() {
    let image = Scene::grid_of_balls([140, 70], 2, 1, 5).render().image;
    let illuminant = IlluminantSetting::Given([0.0, 3.0, 4.0]);
    let params = Params { illuminant, ..Params::default() };
    let (_, trace) = Session::new(Arc::new(image)).run_traced(&params, &mut ()).unwrap();
    let is_light =
        |event: &&Event| matches!(event, Event::IlluminantGiven(_) | Event::IlluminantEstimated(_));
    let lights: Vec<&Event> = trace.events().map(|(_, event)| event).filter(is_light).collect();
    assert_eq!(lights, [&Event::IlluminantGiven(IlluminantGiven { direction: [0.0, 0.6, 0.8] })]);
}
