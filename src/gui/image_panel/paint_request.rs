//! Pictures to be painted: layers, marks, instants of the debugger, and the identity of what was painted.

use crate::app::State;
use crate::raster::{Mask, Raster};
use crate::view::{
    Against, Elsewhere, Fill, ImageSettings, Instant, Item, Layer, LayerNeed, Look, NamedMarks, Picture,
    ResultSnapshot, Selection, marks, paint_against, paint_instant,
};
use std::sync::{Arc, Weak};

/// A picture to be painted.
#[derive(Clone)]
pub struct PaintRequest {
    picture: Arc<Picture>,
    shown: Option<Arc<ResultSnapshot>>,
    pinned: Option<Arc<ResultSnapshot>>,
    elsewhere: Option<Arc<Elsewhere>>,
    subject: Subject,
    /// Side of a texel of the painted picture, pixels of the photograph.
    texel_px: usize,
}

#[derive(Clone)]
enum Subject {
    Layer(Layer, Look),
    Marks(Selection, Option<Item>),
    Instant(Arc<Instant>, Look),
}

impl PaintRequest {
    /// The request of a layer. Settings that do not change the picture are left out, so that the picture is not painted again.
    /// Before the first result and its preview, the photograph stands for the layers of a result.
    pub fn layer(state: &State, layer: Layer, settings: &ImageSettings) -> Option<Self> {
        let has_result = state.shown().is_some() || state.shown_preview().is_some();
        let layer = if layer.needs_result() && !has_result { Layer::Input } else { layer };
        let picture = Arc::clone(state.picture.as_ref()?);
        let preview = state.shown_preview().filter(|_| layer.needs_result() && layer.need().is_none());
        let selected = preview.map_or_else(|| state.selected_region(), |(_, selected)| selected);
        let mut look = settings.look(selected.filter(|_| layer.dims_regions()));
        if !layer.is_overlay() {
            (look.fill, look.opacity) = (Fill::Fill, 1.0);
        }
        let newest = || state.shown().filter(|_| layer.needs_result());
        let shown = preview.map_or_else(newest, |(preview, _)| Some(&preview.shown)).cloned();
        let texel_px = preview.map_or(1, |(preview, _)| preview.blocks.side());
        let pinned = state.pinned.as_ref().filter(|_| layer.need() == Some(LayerNeed::Pinned)).cloned();
        let is_of_elsewhere = matches!(layer.need(), Some(LayerNeed::Elsewhere(_)));
        let elsewhere = state.elsewhere.as_ref().filter(|_| is_of_elsewhere).cloned();
        Some(Self { picture, shown, pinned, elsewhere, subject: Subject::Layer(layer, look), texel_px })
    }

    /// The request of a layer of the photograph that the second view shows for comparison; none where no photograph is compared.
    pub fn compared_layer(state: &State, layer: Layer, settings: &ImageSettings) -> Option<Self> {
        let other = state.compared_photograph()?;
        let has_result = other.newest.is_some();
        let layer = if layer.need().is_some() || (layer.needs_result() && !has_result) {
            Layer::Input
        } else {
            layer
        };
        Some(Self {
            picture: Arc::clone(&other.picture),
            shown: other.newest.clone(),
            pinned: None,
            elsewhere: None,
            subject: Subject::Layer(layer, settings.look(None)),
            texel_px: 1,
        })
    }

    /// The request of the marks: marked, selected and hovered pixels; none where none of these is larger than a pixel.
    pub fn marks(state: &State) -> Option<Self> {
        // Regions and windows of the result do not exist yet at the debugger's cursor, and no more in the preview of the next result.
        let has_regions = state.followed().is_none() && state.shown_preview().is_none();
        let large = |item: &Item| match item {
            Item::Pixel(_) => false,
            Item::Region(_) | Item::Window(_) => has_regions,
            Item::Bin(_) => true,
        };
        let hover = state.hover.filter(large);
        let mut selection = state.document.selection.clone();
        selection.item = selection.item.filter(large);
        if selection.is_empty() && selection.named.marks.is_empty() && hover.is_none() {
            return None;
        }
        let picture = Arc::clone(state.picture.as_ref()?);
        let shown = state.shown().cloned();
        let subject = Subject::Marks(selection, hover);
        Some(Self { picture, shown, pinned: None, elsewhere: None, subject, texel_px: 1 })
    }

    /// The request of the outline of the selected region in the preview of the next result; none where there is no such region.
    pub fn preview_outline(state: &State) -> Option<Self> {
        let (preview, region) = state.outlined_in_preview()?;
        let selection = Selection {
            item: Some(Item::Region(region)),
            marked: None,
            // Named marks have pixels of the photograph and are not painted in working pixels.
            named: Arc::clone(&state.document.selection.named),
        };
        Some(Self {
            picture: Arc::clone(state.picture.as_ref()?),
            shown: Some(Arc::clone(&preview.shown)),
            pinned: None,
            elsewhere: None,
            subject: Subject::Marks(selection, None),
            texel_px: preview.blocks.side(),
        })
    }

    /// The request of the instant at the cursor.
    pub fn instant(state: &State, instant: &Arc<Instant>) -> Option<Self> {
        let picture = Arc::clone(state.picture.as_ref()?);
        let look = Look { exposure_ev: 0.0, gamma: 1.0, ..state.view.image.look(None) };
        Some(Self {
            picture,
            shown: None,
            pinned: None,
            elsewhere: None,
            subject: Subject::Instant(Arc::clone(instant), look),
            texel_px: 1,
        })
    }

    /// Side of a texel of the painted picture, pixels of the photograph.
    pub const fn texel_px(&self) -> usize {
        self.texel_px
    }

    /// Number of texels of the painted picture.
    pub fn texels(&self) -> usize {
        self.picture.photo.image.pixels.len() / self.texel_px.pow(2)
    }

    /// Paints the picture.
    pub fn paint(&self) -> Raster<[u8; 4]> {
        let (shown, pinned) = (self.shown.as_deref(), self.pinned.as_deref());
        match &self.subject {
            Subject::Layer(layer, look) => {
                let against = Against { pinned, elsewhere: self.elsewhere.as_deref() };
                paint_against(*layer, &self.picture, shown, against, look)
            }
            Subject::Marks(selection, hover) => {
                let painted_marks = marks(&self.picture, shown, selection, *hover);
                // Where nothing is marked, one transparent texel.
                painted_marks.unwrap_or_else(|| Raster::filled(1, 1, [0; 4]))
            }
            Subject::Instant(instant, look) => {
                let (width, height) = self.picture.size();
                paint_instant(instant, width, height, look)
            }
        }
    }

    /// The identity of the painted picture.
    pub fn key(&self) -> TextureKey {
        let downgraded =
            |shown: &Option<Arc<ResultSnapshot>>| shown.as_ref().map(Arc::downgrade).unwrap_or_default();
        let subject = match &self.subject {
            Subject::Layer(layer, look) => SubjectKey::Layer(*layer, *look),
            Subject::Marks(selection, hover) => {
                let marked = selection.marked.as_ref().map(Arc::downgrade).unwrap_or_default();
                SubjectKey::Marks(selection.item, marked, Arc::downgrade(&selection.named), *hover)
            }
            Subject::Instant(instant, look) => SubjectKey::Instant(Arc::downgrade(instant), *look),
        };
        TextureKey {
            picture: Arc::downgrade(&self.picture),
            shown: downgraded(&self.shown),
            pinned: downgraded(&self.pinned),
            elsewhere: self.elsewhere.as_ref().map(Arc::downgrade).unwrap_or_default(),
            subject,
        }
    }
}

/// The identity of a texture. Weak references do not keep results alive.
#[derive(Clone)]
pub struct TextureKey {
    picture: Weak<Picture>,
    shown: Weak<ResultSnapshot>,
    pinned: Weak<ResultSnapshot>,
    elsewhere: Weak<Elsewhere>,
    subject: SubjectKey,
}

#[derive(Clone)]
enum SubjectKey {
    Layer(Layer, Look),
    Marks(Option<Item>, Weak<Mask>, Weak<NamedMarks>, Option<Item>),
    Instant(Weak<Instant>, Look),
}

impl TextureKey {
    /// Whether the texture is of the photograph of a request.
    pub fn is_of_photograph(&self, request: &PaintRequest) -> bool {
        Weak::ptr_eq(&self.picture, &Arc::downgrade(&request.picture))
    }

    /// Whether the texture is of marks.
    pub const fn is_of_marks(&self) -> bool {
        matches!(self.subject, SubjectKey::Marks(..))
    }

    /// Whether the texture is of an instant at the debugger's cursor.
    pub const fn is_of_instant(&self) -> bool {
        matches!(self.subject, SubjectKey::Instant(..))
    }

    /// Whether the photograph or a result of the texture is no longer in memory.
    pub fn is_outdated(&self) -> bool {
        let is_gone =
            |shown: &Weak<ResultSnapshot>| shown.strong_count() == 0 && !Weak::ptr_eq(shown, &Weak::new());
        self.picture.strong_count() == 0 || is_gone(&self.shown) || is_gone(&self.pinned)
    }
}

impl PartialEq for TextureKey {
    fn eq(&self, other: &Self) -> bool {
        let subject = match (&self.subject, &other.subject) {
            (SubjectKey::Layer(a, b), SubjectKey::Layer(c, d)) => (a, b) == (c, d),
            (SubjectKey::Marks(a, b, c, d), SubjectKey::Marks(e, f, g, h)) => {
                (a, d) == (e, h) && Weak::ptr_eq(b, f) && Weak::ptr_eq(c, g)
            }
            (SubjectKey::Instant(a, b), SubjectKey::Instant(c, d)) => b == d && Weak::ptr_eq(a, c),
            _ => false,
        };
        subject
            && Weak::ptr_eq(&self.picture, &other.picture)
            && Weak::ptr_eq(&self.shown, &other.shown)
            && Weak::ptr_eq(&self.pinned, &other.pinned)
            && Weak::ptr_eq(&self.elsewhere, &other.elsewhere)
    }
}
