//! What every pixel sees.

/// What kind of primitive a fragment shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Kind {
    /// A segment of a strand; its index is that of its first point.
    Segment = 0,
    /// A triangle.
    Triangle = 1,
}

/// One primitive in one pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragment {
    /// Segment or triangle.
    pub kind: Kind,
    /// First point of the segment, or index of the triangle.
    pub primitive: u32,
    /// Middle of the samples that see it. Segment: position from 0 to 1 along, and -1 to 1 across, of the strand.
    /// Triangle: barycentric coordinates of the second and third corner. Right in perspective.
    pub parameter: [f32; 2],
    /// Share of the pixel, a multiple of 1/16.
    pub weight: f32,
    /// Depth as given with the vertices (linear on the screen).
    pub depth: f32,
}

/// Fragments of all pixels, row by row, from front to back within a pixel.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GBuffer {
    /// First fragment of every pixel, and the number of fragments.
    pub pixel_offsets: Vec<i64>,
    /// The fragments.
    pub fragments: Vec<Fragment>,
}
