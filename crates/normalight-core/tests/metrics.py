"""Errors of normals and lights, written once more with numpy: JSON on standard input and output."""
import json
import sys

import numpy as np

given = json.load(sys.stdin)
estimate, truth = np.array(given["estimate"]), np.array(given["truth"])
inside = np.array(given["inside"]) & (np.abs(truth).sum(axis=1) > 0)
estimate, truth = estimate[inside], truth[inside]


def degrees(a, b):
    a = a / np.linalg.norm(a, axis=1, keepdims=True)
    b = b / np.linalg.norm(b, axis=1, keepdims=True)
    return np.rad2deg(np.arccos(np.clip(np.einsum("ij,ij->i", a, b), -1, 1)))


angles = np.full(len(truth), 90.0)
told = np.linalg.norm(estimate, axis=1) > 0
angles[told] = degrees(estimate[told], truth[told])
directions = degrees(np.array(given["found_directions"]), np.array(given["directions"]))
found, real = np.array(given["found_intensities"]), np.array(given["intensities"])
real = real / real[0]
scale = np.linalg.lstsq(found.reshape(-1, 1), real.ravel(), rcond=None)[0][0]
json.dump(
    {
        "mean": angles.mean(),
        "median": np.median(angles),
        "shares": [(angles < limit).mean() for limit in (11.25, 22.5, 30)],
        "pixels": len(angles),
        "light": directions.mean(),
        "intensity": (np.abs(scale * found - real) / real).mean(),
    },
    sys.stdout,
)
