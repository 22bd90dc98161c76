//! Which columns of a table have room in a panel, and how wide they are.

use egui::{Color32, TextStyle, Ui};
use egui_extras::{Column, TableBuilder};

/// A column of a table: what it shows, and its least width in points.
pub type TableColumn<K> = (K, f32);

/// The columns that fit into `room_pt` points, with `gap_pt` points between them. Those of `dispensable` are left out one after the other
/// until the rest fits.
pub fn fitting<K: PartialEq>(
    mut columns: Vec<TableColumn<K>>,
    dispensable: &[K],
    gap_pt: f32,
    room_pt: f32,
) -> Vec<TableColumn<K>> {
    let total_pt =
        |columns: &[TableColumn<K>]| columns.iter().map(|(_, width)| width + gap_pt).sum::<f32>() - gap_pt;
    for key in dispensable {
        if total_pt(&columns) <= room_pt {
            break;
        }
        columns.retain(|(column, _)| column != key);
    }
    columns
}

/// The table with these columns, of which the last takes the rest of the panel.
pub fn with_columns<'a, K>(mut table: TableBuilder<'a>, columns: &[TableColumn<K>]) -> TableBuilder<'a> {
    for (index, &(_, width)) in columns.iter().enumerate() {
        let is_last = index + 1 == columns.len();
        // A column that is not clipped never gets narrower than its contents were, and these fill it.
        table = table.column(if is_last {
            Column::remainder().at_least(width).clip(true)
        } else {
            Column::exact(width)
        });
    }
    table
}

/// Width of the widest of these texts, points.
pub fn widest(ui: &Ui, texts: impl Iterator<Item = String>) -> f32 {
    let font = TextStyle::Body.resolve(ui.style());
    let width = |text| ui.painter().layout_no_wrap(text, font.clone(), Color32::WHITE).size().x.ceil();
    texts.map(width).fold(0.0, f32::max)
}

/// Width of a column in which none of these numbers is cut, points.
pub fn count_width(ui: &Ui, counts: impl Iterator<Item = usize>) -> f32 {
    widest(ui, counts.max().map(crate::describe::grouped).into_iter())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_left_out_in_their_order_until_the_rest_fits() {
        let columns = || vec![('p', 40.0), ('q', 30.0), ('r', 20.0), ('s', 10.0)];
        let names = |room_pt| -> String {
            fitting(columns(), &['r', 'q'], 5.0, room_pt).into_iter().map(|(key, _)| key).collect()
        };
        assert_eq!(names(115.0), "pqrs", "four columns and three gaps");
        assert_eq!(names(114.0), "pqs");
        assert_eq!(names(89.0), "ps");
        assert_eq!(names(0.0), "ps", "the others are not dispensable");
    }
}
