//! Which stages a changed parameter makes stale: the first stage that reads the parameter, and all later ones.
//!
//! The key of a stage's output contains the parameters that the stages up to this one read. Parameters that only later stages
//! read have a fixed value in the key, so that a change of such a parameter leaves the output valid.

use super::Stage;
use crate::params::{AmbientSetting, Parameter, Reading, Rules, Switch, UsedParams};

/// The parameters and switches that `stage` and the stages before it read; all other parameters are 0 and switches off.
///
/// The tables of parameters, refinements and readings name the first stage that reads each ([`Parameter::spec`],
/// [`Switch::first_stage`], [`Reading::first_stage`]).
/// The planar stage is the first that reads a given light or second lamp, the split is the first that reads the ambient light.
pub fn seen_up_to(stage: Stage, used: &UsedParams, rules: Rules) -> (UsedParams, Rules) {
    let (mut used, mut rules) = (*used, rules);
    for parameter in Parameter::ALL {
        if stage < parameter.spec().first_stage {
            *used.slot(parameter) = 0.0;
        }
    }
    if stage < Stage::Planar {
        (used.illuminant, used.second_illuminant) = (None, None);
    }
    if stage < Stage::Split {
        used.ambient = AmbientSetting::Auto;
    }
    for switch in Switch::ALL {
        if stage < switch.first_stage() {
            rules.refine.set(switch, false);
        }
    }
    for reading in Reading::ALL {
        if stage < reading.first_stage() {
            rules.readings.set(reading, false);
        }
    }
    (used, rules)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;
    use crate::params::{Baseline, Readings, Refine};

    /// Otherwise a changed parameter could leave an output valid that was made with the old value.
    #[test]
    fn from_its_first_stage_on_every_parameter_and_switch_is_seen() {
        let used = UsedParams::paper();
        let rules = Rules {
            refine: Refine::all(true),
            readings: Readings::all(true),
            baseline: Some(Baseline::TopDown),
        };
        for stage in Stage::ALL {
            let (seen, switches) = seen_up_to(stage, &used, rules);
            for parameter in Parameter::ALL {
                let reads = parameter.spec().first_stage <= stage;
                assert_eq!(seen.get(parameter) == used.get(parameter), reads, "{parameter:?} in {stage:?}");
            }
            for switch in Switch::ALL {
                let is_seen = switches.refine.get(switch);
                assert_eq!(is_seen, switch.first_stage() <= stage, "{switch:?} in {stage:?}");
            }
            for reading in Reading::ALL {
                let is_seen = switches.readings.get(reading);
                assert_eq!(is_seen, reading.first_stage() <= stage, "{reading:?} in {stage:?}");
            }
        }
        assert_eq!(seen_up_to(Stage::Split, &used, rules), (used, rules));
    }
}
