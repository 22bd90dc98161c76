//! The Dichromatic Reflection Model itself: what light and surface do, before anybody looks for it in an image.

pub mod photometry;
