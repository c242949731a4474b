"""Gaussian mixtures of few dimensions, fitted to weighted samples. Deterministic."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Mixture:
    """K Gaussians in D dimensions: `weight` (K,) adding up to 1, `mean` (K, D), `covariance` (K, D, D), all float64."""

    weight: NDArray[np.float64]
    mean: NDArray[np.float64]
    covariance: NDArray[np.float64]


def fitted_mixture(
    samples: NDArray[np.floating],
    *,
    weights: NDArray[np.floating],
    count: int,
    floor: NDArray[np.float64],
    iterations: int = 6,
) -> Mixture:
    """Maximum-likelihood mixture of at most `count` Gaussians of `samples` (N, D) with `weights` (N,) >= 0.

    `floor` (D,) is a variance added to every axis, so that a handful of like samples does not become a spike. Begins
    with means at the weighted quantiles along the axis of largest variance, then runs `iterations` of
    expectation-maximisation. With no weight at all the result is a single Gaussian around the mean of all samples.
    """
    samples = samples.astype(np.float64)
    weights = weights.astype(np.float64)
    if weights.sum() <= 0:
        weights, count = np.ones(len(samples)), 1
    samples, weights = samples[weights > 0], weights[weights > 0]
    share = _first_shares(samples, weights, count)
    mixture = _maximised(samples, share * weights, floor)
    for _ in range(iterations):
        logs = _component_logs(mixture, samples)
        share = np.exp(logs - _log_sum(logs))
        mixture = _maximised(samples, share * weights, floor)
    return mixture


def log_density(mixture: Mixture, samples: NDArray[np.floating]) -> NDArray[np.float64]:
    """Natural logarithm of the mixture's density at `samples` (N, D): (N,)."""
    return _log_sum(_component_logs(mixture, samples.astype(np.float64)))


def _first_shares(samples: NDArray[np.float64], weights: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """(K, N): how much of every sample belongs to each component."""
    mean = np.average(samples, axis=0, weights=weights)
    covariance = np.cov(samples.T, aweights=weights + 1e-12, ddof=0).reshape(len(mean), len(mean))
    axis = np.linalg.eigh(covariance)[1][:, -1]
    axis = axis * np.sign(axis[np.argmax(np.abs(axis))])
    along = (samples - mean) @ axis
    order = np.argsort(along, kind="stable")
    rank = np.empty(len(samples))
    rank[order] = np.cumsum(weights[order]) / weights.sum()
    return np.eye(count)[:, np.minimum((rank * count).astype(int), count - 1)]


def _maximised(samples: NDArray[np.float64], share: NDArray[np.float64], floor: NDArray[np.float64]) -> Mixture:
    mass = share.sum(axis=1)
    share = share[mass > 1e-6 * mass.sum()]
    mass = share.sum(axis=1)
    mean = (share @ samples) / mass[:, None]
    covariance = [_scatter(samples - mean[k], share[k]) / mass[k] + np.diag(floor) for k in range(len(mass))]
    return Mixture(mass / mass.sum(), mean, np.stack(covariance))


def _scatter(away: NDArray[np.float64], share: NDArray[np.float64]) -> NDArray[np.float64]:
    return (away * share[:, None]).T @ away


def _component_logs(mixture: Mixture, samples: NDArray[np.float64]) -> NDArray[np.float64]:
    """(K, N): logarithm of every component's part of the density."""
    whitening = np.linalg.inv(np.linalg.cholesky(mixture.covariance))
    distance_sq = [
        np.square(white @ (samples - mean).T).sum(axis=0) for mean, white in zip(mixture.mean, whitening, strict=True)
    ]
    log_volume = np.linalg.slogdet(2 * np.pi * mixture.covariance)[1]
    return (np.log(mixture.weight) - 0.5 * log_volume)[:, None] - 0.5 * np.stack(distance_sq)


def _log_sum(logs: NDArray[np.float64]) -> NDArray[np.float64]:
    top = logs.max(axis=0)
    return top + np.log(np.exp(logs - top).sum(axis=0))
