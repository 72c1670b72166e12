use gemm::Parallelism;

/// A matrix in a slice: element `(r, c)` is at `r * row_step + c * column_step`.
#[derive(Clone, Copy)]
pub(crate) struct View<'a> {
    pub(crate) values: &'a [f32],
    pub(crate) row_step: usize,
    pub(crate) column_step: usize,
}

impl<'a> View<'a> {
    /// Rows one after the other, `row_step` apart.
    pub(crate) fn rows(values: &'a [f32], row_step: usize) -> Self {
        Self {
            values,
            row_step,
            column_step: 1,
        }
    }

    pub(crate) fn transposed(self) -> Self {
        Self {
            row_step: self.column_step,
            column_step: self.row_step,
            ..self
        }
    }
}

/// What happens to the values that were there.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Before {
    Added,
    Overwritten,
}

/// `output = left * right`, or added to it; `size` is `[rows, columns, inner]`, `row_step` the
/// distance of the output's rows.
pub(crate) fn product(
    [rows, columns, inner]: [usize; 3],
    output: &mut [f32],
    row_step: usize,
    before: Before,
    left: View<'_>,
    right: View<'_>,
) {
    if rows == 0 || columns == 0 {
        return;
    }
    let last = |rows: usize, columns: usize, view: &View<'_>| {
        (rows - 1) * view.row_step + (columns - 1) * view.column_step
    };
    assert!(
        inner > 0
            && last(rows, inner, &left) < left.values.len()
            && last(inner, columns, &right) < right.values.len()
            && (rows - 1) * row_step + columns - 1 < output.len()
            && (row_step >= columns || rows == 1),
        "a matrix product reaches beyond its slices"
    );
    let added = before == Before::Added;
    #[expect(
        unsafe_code,
        reason = "the library takes pointers; every index is checked above"
    )]
    // SAFETY: the largest index of each matrix lies inside its slice, all steps are non-negative,
    // the output's rows do not overlap, and the borrows keep the three apart.
    unsafe {
        gemm::gemm(
            rows,
            columns,
            inner,
            output.as_mut_ptr(),
            1,
            row_step as isize,
            added,
            left.values.as_ptr(),
            left.column_step as isize,
            left.row_step as isize,
            right.values.as_ptr(),
            right.column_step as isize,
            right.row_step as isize,
            1.0,
            1.0,
            false,
            false,
            false,
            Parallelism::None,
        );
    }
}
