//! What is to be drawn, as plain data.
//!
//! Positions are in world units (counts / 255). Colors are sRGB bytes red, green, blue and straight alpha; they are
//! blended as they are, like the window's own. Sizes and widths are in logical pixels: the renderer multiplies them with
//! the screen's scale.

use bytemuck::{Pod, Zeroable};
use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// A shared list that knows whether it is the same as before: clones are, a new list never is.
///
/// The renderer uploads a batch once and draws it until it is gone from the scene.
#[derive(Clone, Debug)]
pub struct Batch<T> {
    items: Arc<[T]>,
    revision: u64,
}

impl<T> Batch<T> {
    /// A new batch, different from all others.
    pub fn new(items: impl Into<Arc<[T]>>) -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        let items = items.into();
        // All empty lists are the same one: nothing is drawn again when nothing replaces nothing.
        let revision = if items.is_empty() { 0 } else { NEXT.fetch_add(1, Ordering::Relaxed) };
        Self { items, revision }
    }

    /// A number that no other content has while the program runs.
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
    /// sRGB and straight alpha. A translucent point still hides what is drawn behind it later.
    pub color: [u8; 4],
    /// Diameter, logical pixels, whatever the distance.
    pub size_px: f32,
}

/// Where a line shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Overlay {
    /// Where nothing nearer hides it: the wire cube.
    #[default]
    Hidden,
    /// Everywhere, faintly behind nearer points: axes of cylinders within their cluster.
    Faint,
    /// Everywhere, on top of all else: the selection.
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
    /// Logical pixels, whatever the distance.
    pub width_px: f32,
    /// Length of dashes and of the gaps between them, logical pixels; 0: a solid line.
    pub dash_px: f32,
    /// What happens where something nearer is in the way.
    pub overlay: Overlay,
}

/// A corner of a solid's triangle. `solids.wgsl` reads this layout.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    /// World units.
    pub position: [f32; 3],
    /// Unit vector out of the solid; of an open sheet either side.
    pub normal: [f32; 3],
    /// sRGB and straight alpha of the surface seen face-on; it thickens towards the silhouette.
    pub color: [u8; 4],
}

/// A translucent solid or sheet, seen from both sides.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub(super) triangles: Batch<Vertex>,
    pub(super) center: [f32; 3],
}

impl Mesh {
    /// Three vertices a triangle, counter-clockwise seen from outside.
    ///
    /// Back faces are drawn before front faces, and far meshes before near ones: exact for convex solids that do not
    /// intersect, close enough for the rest.
    pub fn new(triangles: Vec<Vertex>) -> Self {
        let n = triangles.len().max(1) as f32;
        let center = [0, 1, 2].map(|axis| triangles.iter().map(|v| v.position[axis]).sum::<f32>() / n);
        Self { triangles: Batch::new(triangles), center }
    }

    /// Its vertices, three a triangle.
    pub fn triangles(&self) -> &Batch<Vertex> {
        &self.triangles
    }
}

/// Everything that is drawn: points, then solids over what lies behind them, then the lines that lie over all.
#[derive(Clone, Debug)]
pub struct Scene {
    /// sRGB and straight alpha; transparent for a picture to paste elsewhere.
    pub background: [u8; 4],
    /// Clouds of points. What changes at another pace (a hovered point, a selection) is best a batch of its own.
    pub points: Vec<Batch<Point>>,
    /// All lines.
    pub lines: Batch<Line>,
    /// Translucent solids.
    pub meshes: Vec<Mesh>,
}

impl Default for Scene {
    /// Nothing on black.
    fn default() -> Self {
        Self { background: [0, 0, 0, 255], points: Vec::new(), lines: Batch::default(), meshes: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_batch_is_itself_and_no_other() {
        let one = Batch::new(vec![1, 2, 3]);
        assert_eq!(one.revision(), one.clone().revision());
        assert_ne!(one.revision(), Batch::new(vec![1, 2, 3]).revision());
        assert_eq!(Batch::<u8>::default().revision(), Batch::new(Vec::<u8>::new()).revision());
        assert_eq!(one.len(), 3);
    }

    #[test]
    fn the_layouts_that_the_shaders_read() {
        assert_eq!(size_of::<Point>(), 20);
        assert_eq!(size_of::<Vertex>(), 28);
    }
}
