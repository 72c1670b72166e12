//! Rows of cells.
use crate::graph::{GraphBuilder, Value};
use normalight_model::{Cell, Edge, ModelError, Operation};

impl GraphBuilder<'_> {
    /// A normal cell, then a reduction and a normal cell so many times.
    pub(crate) fn feature_cells(
        &mut self,
        path: &str,
        [normal, reduction]: [&Cell; 2],
        reductions: usize,
        stem: &Value,
    ) -> Result<Value, ModelError> {
        let mut cells = vec![(normal, 1)];
        for _ in 0..reductions {
            cells.extend([(reduction, 2), (normal, 1)]);
        }
        self.cells(path, &cells, stem)
    }

    /// Cells `path.0`, `path.1` and so on with their strides; both inputs of the first are the stem.
    pub(crate) fn cells(
        &mut self,
        path: &str,
        cells: &[(&Cell, usize)],
        stem: &Value,
    ) -> Result<Value, ModelError> {
        let (mut before_last, mut last) = (stem.clone(), stem.clone());
        let mut last_stride = 1;
        for (place, &(cell, stride)) in cells.iter().enumerate() {
            let path = format!("{path}.{place}");
            let first = match last_stride {
                1 => self.pointwise_relu(&format!("{path}.before_last.Pointwise"), &before_last)?,
                _ => self.reduce(&format!("{path}.before_last.Reduce"), &before_last)?,
            };
            let second = self.pointwise_relu(&format!("{path}.last.Pointwise"), &last)?;
            let output = self.cell(&path, cell, stride, [first, second])?;
            (before_last, last, last_stride) = (last, output, stride);
        }
        Ok(last)
    }

    fn cell(
        &mut self,
        path: &str,
        cell: &Cell,
        stride: usize,
        inputs: [Value; 2],
    ) -> Result<Value, ModelError> {
        let mut states = Vec::from(inputs);
        for (node, edges) in cell.nodes.iter().enumerate() {
            let mut sums = Vec::new();
            for (place, edge) in edges.iter().enumerate() {
                let path = format!("{path}.edges.Chosen.operations.{}.kind", 2 * node + place);
                // Edges from within the cell have its size already.
                let stride = if edge.from < 2 { stride } else { 1 };
                sums.push(self.edge(&path, edge, stride, &states[edge.from])?);
            }
            states.push(self.add(&sums[0], &sums[1]));
        }
        let nodes: Vec<&Value> = states[2..].iter().collect();
        Ok(self.beside(&nodes))
    }

    fn edge(
        &mut self,
        path: &str,
        edge: &Edge,
        stride: usize,
        input: &Value,
    ) -> Result<Value, ModelError> {
        match edge.operation {
            Operation::Separable1 | Operation::Separable3 | Operation::Separable5 => {
                let part = |part: &str| format!("{path}.Separable.{part}");
                let value = self.depthwise_relu(&part("first_depthwise"), input, stride)?;
                let value = self.convolution(&part("first_pointwise.conv"), &value, 1)?;
                let value = self.depthwise_relu(&part("second_depthwise"), &value, 1)?;
                self.convolution(&part("second_pointwise.conv"), &value, 1)
            }
            Operation::Convolution3 => {
                let value = self.relu(input);
                self.convolution(&format!("{path}.Convolution.conv.conv"), &value, stride)
            }
            Operation::Skip if stride == 2 => self.reduce(&format!("{path}.Skip.reduce"), input),
            Operation::Skip => Ok(input.clone()),
            Operation::Zero => {
                let value = self.every(stride as i64, 0, input);
                let zero = self.floats(&[], &[0.0]);
                Ok(self.node("Mul", &[&value, &zero], &[]))
            }
        }
    }

    /// ReLU and a 1x1 convolution.
    fn pointwise_relu(&mut self, path: &str, input: &Value) -> Result<Value, ModelError> {
        let input = self.relu(input);
        self.convolution(&format!("{path}.conv"), &input, 1)
    }

    /// ReLU, and 1x1 convolutions of the even and of the odd pixels side by side. Sides are even here: views and tiles are
    /// multiples of all strides together.
    fn reduce(&mut self, path: &str, input: &Value) -> Result<Value, ModelError> {
        let input = self.relu(input);
        let even = self.convolution(&format!("{path}.even.conv"), &input, 2)?;
        let moved = self.every(1, 1, &input);
        let odd = self.convolution(&format!("{path}.odd.conv"), &moved, 2)?;
        Ok(self.beside(&[&even, &odd]))
    }
}
