//! Boxes of voxels: layers (z), rows (y), columns (x), x fastest. A picture is a box of one layer.

use crate::FieldError;

/// Number of layers, rows and columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridShape {
    /// Layers (z); 1 for a picture.
    pub layers: usize,
    /// Rows (y).
    pub rows: usize,
    /// Columns (x).
    pub columns: usize,
}

impl GridShape {
    /// Number of cells.
    #[must_use]
    pub fn len(&self) -> usize {
        self.layers * self.rows * self.columns
    }

    /// True where one of the sizes is zero.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Cell number of (layer, row, column).
    #[must_use]
    pub fn index(&self, layer: usize, row: usize, column: usize) -> usize {
        (layer * self.rows + row) * self.columns + column
    }

    /// (layer, row, column) of a cell number.
    #[must_use]
    pub fn place(&self, cell: usize) -> [usize; 3] {
        let row = cell / self.columns;
        [row / self.rows, row % self.rows, cell % self.columns]
    }

    /// Cell numbers of the six neighbours (-x, +x, -y, +y, -z, +z); `None` outside.
    #[must_use]
    pub fn neighbours(&self, cell: usize) -> [Option<usize>; 6] {
        let [layer, row, column] = self.place(cell);
        let sheet = self.rows * self.columns;
        [
            (column > 0).then(|| cell - 1),
            (column + 1 < self.columns).then(|| cell + 1),
            (row > 0).then(|| cell - self.columns),
            (row + 1 < self.rows).then(|| cell + self.columns),
            (layer > 0).then(|| cell - sheet),
            (layer + 1 < self.layers).then(|| cell + sheet),
        ]
    }

    pub(crate) fn expect(&self, name: &'static str, found: usize) -> Result<(), FieldError> {
        let expected = self.len();
        (found == expected).then_some(()).ok_or(FieldError::Length { name, found, expected })
    }
}
