use super::DepthMap;

impl DepthMap {
    /// Mean curvature of the surface at every pixel, in 1 / pixels: positive where it bulges towards the
    /// camera (1 / radius on a ball), zero on planes and outside the mask.
    ///
    /// Half the trace of the shape operator, from differences of positions and of unit normals:
    /// `H = (G N_u.P_u - F (N_u.P_v + N_v.P_u) + E N_v.P_v) / (2 (E G - F^2))` with `E = P_u.P_u`,
    /// `F = P_u.P_v`, `G = P_v.P_v` (do Carmo, Differential Geometry of Curves and Surfaces, 3.3). Where the
    /// surface is torn the other side does not count.
    pub fn mean_curvature(&self) -> Vec<f32> {
        let normals = self.surface_normals();
        let mut curvature = vec![0.0; normals.len()];
        for pixel in self.mask().pixels() {
            let [pu, pv] = self.derivatives(pixel, |pixel| self.position(pixel));
            let [nu, nv] = self.derivatives(pixel, |pixel| normals[pixel]);
            let (e, f, g) = (pu.dot(pu), pu.dot(pv), pv.dot(pv));
            let area = e * g - f * f;
            if area > f32::MIN_POSITIVE {
                let trace = g * nu.dot(pu) - f * (nu.dot(pv) + nv.dot(pu)) + e * nv.dot(pv);
                curvature[pixel] = trace / (2.0 * area);
            }
        }
        curvature
    }
}
