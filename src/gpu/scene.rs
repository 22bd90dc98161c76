//! The scene to draw, as plain data.
//!
//! Positions are in world units (counts / 255). Colors are sRGB bytes red, green, blue and straight alpha; colors
//! are blended without conversion to linear light, like the window's colors. Sizes and widths are in logical pixels: the renderer
//! multiplies sizes and widths by the screen's scale.

use bytemuck::{Pod, Zeroable};
use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// A shared list with a revision: clones have the same revision, every new list has another one.
///
/// The renderer uploads a batch once and draws the batch as long as it is in the scene.
#[derive(Clone, Debug)]
pub struct Batch<T> {
    items: Arc<[T]>,
    revision: u64,
}

impl<T> Batch<T> {
    /// A new batch with a new revision.
    pub fn new(items: impl Into<Arc<[T]>>) -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        let items = items.into();
        // All empty lists have the same revision, so that an empty list that replaces an empty list causes no drawing.
        let revision = if items.is_empty() { 0 } else { NEXT.fetch_add(1, Ordering::Relaxed) };
        Self { items, revision }
    }

    /// A number that no other list has while the program runs.
    pub fn revision(&self) -> u64 {
        self.revision
    }
}

impl<T> Default for Batch<T> {
    fn default() -> Self {
        Self::new([])
    }
}

impl<T> Deref for Batch<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.items
    }
}

/// A round dot that faces the viewer. `points.wgsl` reads this layout.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Point {
    /// Center, world units.
    pub position: [f32; 3],
    /// sRGB and straight alpha. A translucent point hides the points behind it that are drawn later.
    pub color: [u8; 4],
    /// Diameter, logical pixels, at any distance.
    pub size_px: f32,
}

/// The visibility of a line behind nearer points and solids.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Overlay {
    /// The line is visible where nothing nearer hides the line. For the wire cube.
    #[default]
    Hidden,
    /// The line is visible everywhere, faintly behind nearer points. For axes of cylinders within their cluster.
    Faint,
    /// The line is drawn on top of everything. For the selection.
    Over,
}

/// A straight line with round ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// One end, world units; dashes begin here.
    pub a: [f32; 3],
    /// The other end, world units.
    pub b: [f32; 3],
    /// sRGB and straight alpha.
    pub color: [u8; 4],
    /// Width, logical pixels, at any distance.
    pub width_px: f32,
    /// Length of dashes and of the gaps between them, logical pixels; 0: a solid line.
    pub dash_px: f32,
    /// The visibility of the line behind nearer points and solids.
    pub overlay: Overlay,
}

/// A corner of a solid's triangle. `solids.wgsl` reads this layout.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    /// Position, world units.
    pub position: [f32; 3],
    /// Unit vector out of the solid; for an open sheet, to either side.
    pub normal: [f32; 3],
    /// sRGB and straight alpha of the surface seen face-on; opacity rises towards the silhouette.
    pub color: [u8; 4],
}

/// A translucent solid or sheet, seen from both sides.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub(super) triangles: Batch<Vertex>,
    pub(super) center: [f32; 3],
}

impl Mesh {
    /// A mesh with three vertices per triangle, counter-clockwise seen from outside.
    ///
    /// Back faces are drawn before front faces, and far meshes before near ones. The result is exact for convex solids that do not
    /// intersect, and an approximation for other solids.
    pub fn new(triangles: Vec<Vertex>) -> Self {
        let n = triangles.len().max(1) as f32;
        let center = [0, 1, 2].map(|axis| triangles.iter().map(|v| v.position[axis]).sum::<f32>() / n);
        Self { triangles: Batch::new(triangles), center }
    }

    /// The vertices, three per triangle.
    pub fn triangles(&self) -> &Batch<Vertex> {
        &self.triangles
    }
}

/// Everything that is drawn: points first, then solids, then the lines on top.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Color of the background, sRGB and straight alpha; transparent for pictures that are pasted into documents.
    pub background: [u8; 4],
    /// Clouds of points. Points that change at different times (a hovered point, a selection) are best kept in different batches.
    pub points: Vec<Batch<Point>>,
    /// All lines.
    pub lines: Batch<Line>,
    /// Translucent solids.
    pub meshes: Vec<Mesh>,
}

impl Default for Scene {
    /// An empty scene with a black background.
    fn default() -> Self {
        Self { background: [0, 0, 0, 255], points: Vec::new(), lines: Batch::default(), meshes: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clones_of_a_batch_have_one_revision_and_new_batches_have_others() {
        let one = Batch::new(vec![1, 2, 3]);
        assert_eq!(one.revision(), one.clone().revision());
        assert_ne!(one.revision(), Batch::new(vec![1, 2, 3]).revision());
        assert_eq!(Batch::<u8>::default().revision(), Batch::new(Vec::<u8>::new()).revision());
        assert_eq!(one.len(), 3);
    }

    #[test]
    fn sizes_of_the_layouts_that_the_shaders_read() {
        assert_eq!(size_of::<Point>(), 20);
        assert_eq!(size_of::<Vertex>(), 28);
    }
}
