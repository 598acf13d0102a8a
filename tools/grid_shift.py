#!/usr/bin/env python3
"""Shift of a plane film by a reconstruction, in 1e-3 h: the table of docs/decisions/0002, and b of interface/grid_shift.

The plane through (x0, z0) has the normal (sin a, 0, cos a). Its smoothed indicator is sampled at cells: the
profile of a flat film and, of each of its waves k n beyond half a wave a cell, the image theta = k n - 2 pi m e_z.
Mapped to distances and interpolated by cubics, its zero is off by f(x0, z0); b = 2 <f sin 2 pi z0>. Lengths in h.
Needs numpy and scipy.
"""
import numpy as np
from scipy.optimize import brentq
from scipy.special import erf

VARIANCE, FLOOR = 2.0, 0.3


def kernel(z):
    return np.exp(-z) * (1 + z + z * z / 2)


def gaussian(x):
    return np.exp(-x * x / (2 * VARIANCE)) / np.sqrt(2 * np.pi * VARIANCE)


def profile(x):
    return erf(x / np.sqrt(2 * VARIANCE)) / 2 + x * gaussian(x) * (7 - x * x / VARIANCE) / 8


def slope(x):
    u = x * x / VARIANCE
    return (u * u - 10 * u + 15) / 8 * gaussian(x)


LAST = brentq(lambda x: slope(x) - FLOOR * slope(0), 0, np.sqrt(VARIANCE * (5 - np.sqrt(10))))


def distance(c):
    if abs(c) > profile(LAST):
        return np.sign(c) * (LAST + (abs(c) - profile(LAST)) / slope(LAST))
    return brentq(lambda x: profile(x) - c, -LAST - 1e-9, LAST + 1e-9)


WAVES, STEP = np.linspace(-14, 14, 4001, retstep=True)
WAVES = WAVES[np.abs(WAVES) > 0.3]


def potential(x, z, x0, z0, n):
    indicator = profile(n[0] * (x - x0) + n[1] * (z - z0))
    for m in (1, -1):
        tx, tz = WAVES * n[0], WAVES * n[1] - 2 * np.pi * m
        image = -(tz / (WAVES * n[1])) ** 3 * kernel(VARIANCE * (tx * tx + tz * tz) / 2) * (np.abs(tz) < np.pi)
        phase = np.exp(1j * WAVES * (n[0] * (x - x0) + n[1] * (z - z0)))
        indicator += np.sum((image / (1j * WAVES) * phase).real) * STEP / (2 * np.pi)
    return distance(indicator)


def weights(places, x):
    return np.array([np.prod([(x - b) / (a - b) for b in places if b != a]) for a in places])


def shift(x0, z0, n):
    xs, zs = (np.floor(p - 0.5) + np.arange(-1, 3) + 0.5 for p in (x0, z0))
    psi = np.array([[potential(x, z, x0, z0, n) for x in xs] for z in zs])
    return brentq(lambda d: weights(zs, z0 + d * n[1]) @ psi @ weights(xs, x0 + d * n[0]), -0.2, 0.2)


heights = np.arange(0.05, 1, 0.1)
sines = np.sin(2 * np.pi * heights)
for sine in (0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9):
    n = (sine, np.sqrt(1 - sine * sine))
    f = 1e3 * np.array([[shift(x, z, n) for z in heights] for x in (0.05, 0.22, 0.38, 0.55, 0.72, 0.88)])
    b = 2 * np.mean(f * sines)
    left = f - b * sines
    print(f"sin a {sine:.1f}: b {b:.2f}; largest {np.abs(f).max():.1f}, without b {np.abs(left).max():.1f}; "
          f"rms {f.std():.1f}, without b {left.std():.1f}", flush=True)
