/** Every operation there is, at both strides. */
const CELL = {
  nodes: [
    [
      { operation: "separable_1x1", from: 0 },
      { operation: "separable_3x3", from: 1 },
    ],
    [
      { operation: "separable_5x5", from: 0 },
      { operation: "skip", from: 1 },
    ],
    [
      { operation: "convolution_3x3", from: 0 },
      { operation: "zero", from: 1 },
    ],
    [
      { operation: "separable_3x3", from: 2 },
      { operation: "skip", from: 3 },
    ],
  ],
};

/** A genotype file. */
export const CELLS = {
  source: "made up",
  light: {
    feature_normal: CELL,
    feature_reduction: CELL,
    classifier_normal: CELL,
    classifier_reduction: CELL,
  },
  normal: { feature_normal: CELL, feature_reduction: CELL, regressor_normal: CELL },
};

/** A recipe of one step. @param {string} network @param {number} size @param {string} architecture */
const written = (network, size, architecture) => `
network = "${network}"
steps = 1
size = ${size}
batch = 2
images = [3, 4]
validate_every = 1
validation_objects = 1
[optimiser]
warm_up = 1
[${network}.architecture]
${architecture}`;

/** @param {string} body */
const light = (body) => ({
  network: /** @type {const} */ ("light"),
  recipe: written(
    "light",
    64,
    `input_size = 64
bins = { azimuth = 12, elevation = 12, intensity = { count = 5, low = 0.2, high = 2.0, spacing = "linear" } }
[light.architecture.body]
hidden = 8
${body}`,
  ),
});

/** @param {boolean} mask @param {string} body */
const normal = (mask, body) => ({
  network: /** @type {const} */ ("normal"),
  recipe: written("normal", 16, `mask_channel = ${mask}\n[normal.architecture.body]\n${body}`),
});

/** Recipes of networks that do not ship, with each of their layers' settings somewhere. */
export const BODIES = {
  "light-cells": light('kind = "cells"\ngenotype = "cells.json"\nwidth = 2\nstem_strides = [1, 2]'),
  "light-stages": light(`kind = "staged"
features = [
  { width = 4, layers = 2, kind = "separable3", residual = true, normalised = true },
  { width = 6, kind = "separable5" },
]
classifier = [{ width = 4, layers = 2, kind = "pointwise" }, { width = 4, normalised = true }, { width = 4 }]`),
  "normal-pixels": normal(
    true,
    'kind = "plain"\nwidths = [4, 6, 8]\nhead = 4\nresiduals = 2\npixel_branch = 3',
  ),
  "normal-cells": normal(
    false,
    `kind = "cells"
genotype = "cells.json"
width = 2
stem_strides = [1, 2]
upsampling = "transposed"
fused_convolutions = 2`,
  ),
  "normal-stages": normal(
    true,
    `kind = "staged"
down = [
  { width = 4, layers = 2, kind = "separable3" },
  { width = 6, layers = 2, kind = "separable5", residual = true, normalised = true },
  { width = 8, layers = 2, residual = true, normalised = true },
]
up = [{ width = 6, layers = 2, kind = "separable3", residual = true }]
meeting = "max_mean"
exchanges = 2
fused = [{ width = 4, layers = 2, kind = "pointwise", normalised = true }, { width = 4, kind = "separable5" }]
pixels = { width = 3, layers = 3 }`,
  ),
};
