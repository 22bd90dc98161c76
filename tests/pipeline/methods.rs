//! `method = paper` is the algorithm of 1990 with its known weaknesses; each refinement works with and without the
//! others.

use crate::common::{analyze, assert_valid, report, scores_of, truth_of};
use crate::synthetic::Scene;
use dichroscope::describe::Scores;
use dichroscope::params::{Method, Parameter, Params, Refine, Switch};

fn scores(scene: &Scene, method: Method) -> Scores {
    let rendered = scene.render();
    let params = Params::of(method);
    let analysis = analyze(&rendered.image, &params);
    assert_valid(&rendered.image, &analysis, "scene");
    scores_of(&truth_of(scene, &rendered), &rendered.image, &analysis, &params)
}

#[test]
fn the_paper_uses_the_numbers_of_table_6_and_no_refinement() {
    let image = Scene::grid_of_balls([160, 80], 2, 1, 1).render().image;
    let params = Params::paper();
    let analysis = analyze(&image, &params);
    for parameter in Parameter::ALL {
        let spec = parameter.spec();
        assert_eq!(analysis.used.get(parameter).to_bits(), spec.paper.to_bits(), "{}", spec.name);
    }
    assert_eq!(report(&analysis, &params).params.refine, Refine::all(false));
}

#[test]
fn the_paper_finds_the_balls_with_a_light_that_is_biased_towards_them() {
    let mut bias_deg = [0.0, 0.0];
    for seed in [11, 12, 13, 14] {
        let scene = Scene::grid_of_balls([240, 160], 3, 2, seed);
        let [paper, refined] = [Method::Paper, Method::Refined].map(|method| scores(&scene, method));
        assert!(paper.iou.unwrap() > 0.95, "seed {seed}: IoU {:?}", paper.iou);
        assert!(paper.illum_deg < 15.0, "seed {seed}: the light is off by {}\u{b0}", paper.illum_deg);
        bias_deg[0] += paper.illum_deg / 4.0;
        let [rough, fine] = [&paper, &refined].map(|scores| scores.body_deg.unwrap());
        assert!(rough > 2.0 * fine, "seed {seed}: body vectors off by {rough}\u{b0}, refined {fine}\u{b0}");
        bias_deg[1] += refined.illum_deg / 4.0;
    }
    assert!(bias_deg[0] > 3.0 * bias_deg[1], "paper {}\u{b0}, refined {}\u{b0}", bias_deg[0], bias_deg[1]);
}

#[test]
fn every_refinement_can_be_left_out() {
    let image = Scene::grid_of_balls([240, 80], 3, 1, 21).render().image;
    for switch in Switch::ALL {
        let name = switch.name();
        for only in [false, true] {
            // First all refinements but this one, then this one alone.
            let mut refine = Refine::all(!only);
            refine.set(switch, only);
            let analysis = analyze(&image, &Params { refine, ..Params::default() });
            assert_valid(&image, &analysis, name);
            assert!(analysis.intrinsic.regions.len() >= 2, "{name}, alone {only}: balls are lost");
        }
    }
}
