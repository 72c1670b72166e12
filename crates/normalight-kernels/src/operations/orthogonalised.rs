use burn::tensor::Tensor;

/// Coefficients of the quintic that each step applies to the singular values (Jordan et al. 2024, "Muon: an optimizer for
/// hidden layers in neural networks"): chosen to raise small ones fast, so that all end near 1 rather than at it.
const NEWTON_SCHULZ: [f32; 3] = [3.4445, -4.7750, 2.0315];

/// A matrix with the singular vectors of `input` and all singular values near 1 (0.7 to 1.2 after five steps for those that
/// were more than a few thousandths of the matrix's norm): `steps` Newton-Schulz steps `X <- a X + (b A + c A A) X` with
/// `A = X X^T` on the matrix divided by its Frobenius norm. A matrix of zeros stays one. Without gradients.
///
/// # Shapes
/// - input: `[rows, columns]`
/// - output: `[rows, columns]`
pub fn orthogonalised(input: Tensor<2>, steps: usize) -> Tensor<2> {
    let [rows, columns] = input.dims();
    // The smaller side is the one whose products are taken.
    if rows > columns {
        return orthogonalised(input.transpose(), steps).transpose();
    }
    #[cfg(feature = "flex")]
    if super::on_flex(&input) {
        use burn::tensor::TensorData;
        let device = input.device();
        let values = input.detach().into_data().try_to_vec::<f32>();
        let mut values = values.expect("a tensor of f32 holds f32");
        let square: f64 = values.iter().map(|value| f64::from(*value).powi(2)).sum();
        let norm = square.sqrt().max(SMALLEST) as f32;
        values.iter_mut().for_each(|value| *value /= norm);
        let size = [rows, columns];
        crate::cpu::orthogonalise::orthogonalise(&mut values, size, NEWTON_SCHULZ, steps);
        return Tensor::from_data(TensorData::new(values, [rows, columns]), &device);
    }
    let [a, b, c] = NEWTON_SCHULZ;
    let input = input.detach();
    let norm = input.clone().square().sum().sqrt().clamp_min(SMALLEST);
    let mut matrix = input / norm.reshape([1, 1]);
    for _ in 0..steps {
        let square = matrix.clone().matmul(matrix.clone().transpose());
        let factors = square.clone() * b + square.clone().matmul(square) * c;
        matrix = matrix.clone() * a + factors.matmul(matrix);
    }
    matrix
}

/// Keeps the division by the norm finite.
const SMALLEST: f64 = 1e-30;
