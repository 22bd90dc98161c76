//! The changes of parameters that would change a pixel, in words.

use crate::analysis::{Direction, Fate, Home, WhatIf};

/// `joins region 3 at cylinder width ≥ 4.87 (now 3.12)`
pub fn what_if_sentence(what_if: &WhatIf) -> String {
    let WhatIf { parameter, direction, now, at, before, after, .. } = *what_if;
    let spec = parameter.spec();
    let name = spec.name.replace('_', " ");
    // Widths are multiples of σ0, as everywhere.
    let unit = if spec.unit.contains('\u{d7}') { String::new() } else { format!(" {}", spec.unit) };
    let relation = match direction {
        Direction::Up => '\u{2265}',
        Direction::Down => '\u{2264}',
    };
    let now = if now.is_finite() { number(now) } else { "off".to_owned() };
    format!("{} at {name} {relation} {}{unit} (now {now})", becomes(before, after), number(at))
}

fn becomes(before: Fate, after: Fate) -> String {
    let kind = after.kind.name();
    match after.home {
        home if home == before.home => format!("becomes {kind}"),
        Home::Nowhere => "is in no region".to_owned(),
        Home::Region(region) => format!("joins region {region}, {kind},"),
        Home::New => format!("joins a region that is not there now, {kind},"),
    }
}

/// A value without trailing zeros, with at most three digits after the point.
fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    let trimmed = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    trimmed.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Parameter;
    use crate::raster::RegionId;
    use crate::trace::PixelKind;

    #[test]
    fn a_change_names_the_fate_the_parameter_and_what_it_is_now() {
        let nowhere = Fate { home: Home::Nowhere, kind: PixelKind::Unassigned };
        let matte = |home| Fate { home, kind: PixelKind::Matte };
        let say = |parameter, direction, now, at, before, after| {
            let (unchanged_at, predicted) = (now, false);
            what_if_sentence(&WhatIf {
                parameter,
                direction,
                now,
                at,
                unchanged_at,
                before,
                after,
                predicted,
            })
        };
        assert_eq!(
            say(
                Parameter::CylinderWidth,
                Direction::Up,
                4.0,
                4.9,
                nowhere,
                matte(Home::Region(RegionId::from_index(2)))
            ),
            "joins region 3, matte, at cylinder width \u{2265} 4.9 (now 4)"
        );
        assert_eq!(
            say(Parameter::MinArea, Direction::Down, 500.0, 320.0, nowhere, matte(Home::New)),
            "joins a region that is not there now, matte, at min area \u{2264} 320 px (now 500)"
        );
        let highlight = Fate { kind: PixelKind::Highlight, ..matte(Home::Region(RegionId::from_index(2))) };
        assert_eq!(
            say(
                Parameter::CameraNoise,
                Direction::Up,
                2.564_34,
                3.0,
                matte(Home::Region(RegionId::from_index(2))),
                highlight
            ),
            "becomes highlight at camera noise \u{2265} 3 counts (now 2.564)"
        );
        assert_eq!(
            say(Parameter::ClipThreshold, Direction::Down, f64::INFINITY, 80.0, highlight, nowhere),
            "is in no region at clip threshold \u{2264} 80 counts (now off)"
        );
    }
}
