//! Weights of linear interpolation between cells.

/// The two cells nearest to `position` of `count` cells, each with its weight in a linear interpolation; the weights add up to 1.
/// `position` is in cells: the center of cell 0 lies at 0.5. Outside of the outer centers the outer cell has all the weight.
pub(super) fn linear_weights(position: f32, count: usize) -> [(usize, f32); 2] {
    let last = count.saturating_sub(1);
    let at = (position - 0.5).clamp(0.0, last as f32);
    let first = at as usize;
    [(first, 1.0 - at.fract()), ((first + 1).min(last), at.fract())]
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;

    #[test]
    fn a_position_between_two_centers_has_a_share_of_both() {
        assert_eq!(linear_weights(1.75, 4), [(1, 0.75), (2, 0.25)]);
        assert_eq!(linear_weights(0.5, 4), [(0, 1.0), (1, 0.0)]);
        assert_eq!(linear_weights(0.1, 4)[0], (0, 1.0));
        assert_eq!(linear_weights(3.9, 4), [(3, 1.0), (3, 0.0)]);
        assert_eq!(linear_weights(0.7, 1), [(0, 1.0), (0, 0.0)]);
    }
}
