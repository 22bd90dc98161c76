use crate::gui::App;
use crate::gui::testing::{harness, open_sample};
use crate::workbench::{ColourBy, ColourSpace, Command, Item, Theme};

#[test]
fn pictures() {
    let Some((mut h, _)) = harness() else { return };
    open_sample(&mut h);
    let dir = std::env::var("LOOK").unwrap_or_default();
    if dir.is_empty() {
        return;
    }
    let shot = |h: &mut egui_kittest::Harness<App>, name: &str| {
        h.run_steps(4);
        h.render().unwrap().save(format!("{dir}/{name}.png")).unwrap();
    };
    shot(&mut h, "1-open");
    h.state_mut().apply(Command::Select(Some(Item::Region(1))));
    shot(&mut h, "2-region1");
    for space in [ColourSpace::Lab, ColourSpace::Hsv, ColourSpace::Chromaticity, ColourSpace::LogRgb] {
        let mut cube = h.state().state().view.cube.clone();
        cube.space = space;
        h.state_mut().apply(Command::Cube(cube));
        shot(&mut h, &format!("3-{space:?}"));
    }
    let mut cube = h.state().state().view.cube.clone();
    cube.space = ColourSpace::Rgb;
    cube.colour_by = ColourBy::Region;
    h.state_mut().apply(Command::Cube(cube.clone()));
    h.state_mut().apply(Command::Theme(Theme::Light));
    shot(&mut h, "4-light");
    cube.colour_by = ColourBy::Density;
    h.state_mut().apply(Command::Cube(cube.clone()));
    h.state_mut().apply(Command::Select(None));
    shot(&mut h, "5-density-light");
}
