#pragma once

#include <complex>
#include <optional>

#include "frangia/phase/waveform/fit_waveform.h"

namespace frangia {

/// Adds the harmonics that few frames do not tell from those that are found: harmonic N + 1 of N
/// frames changes the contrast as N - 1 does and shifts the phase the other way.
///
/// A square wave with any blur has odd harmonics alone, and the third one gives its blur and so all
/// others. Any other response of a projector is near a power law, whose fourth harmonic follows
/// from the second. The standard deviation of an added odd harmonic is a quarter of it; that of the
/// fourth follows from the second and from how far the third departs from a power law.
///
/// @shape    `third`: of three frames, from the ripple of their mean
void add_hidden_harmonics(std::size_t frames,
                          const std::optional<std::complex<double>>& third,
                          WaveformFit& fit);

/// Harmonic n of a square wave relative to its fundamental, after a blur with a sigma of `blur_rad`
/// of its phase.
[[nodiscard]] double square_harmonic(int order, double blur_rad);

}  // namespace frangia
