#pragma once

#include <string_view>

namespace boresight::plant {

enum class GustSpectrumKind { davenport, von_karman, kaimal, eurocode };
std::string_view to_string(GustSpectrumKind kind);

/// The spectrum of the longitudinal gust at one point, for any mean speed V. With sigma^2 =
/// gust_variance and x = f L/V:
///
///   davenport    f S = sigma^2 (2/3) x^2/(1 + x^2)^(4/3)     sigma^2 = 6 kappa V^2, L = 1200 m
///   von_karman   f S = sigma^2 4 x/(1 + c x^2)^(5/6)         sigma = I V, L the integral length
///   kaimal       f S = sigma^2 4 x/(1 + 6 x)^(5/3)           sigma = I V, L = 8.1 Lambda
///   eurocode     f S = sigma^2 6.8 x/(1 + 10.2 x)^(5/3)      sigma = I V, L = L(z)
///
/// A. G. Davenport, Q. J. Royal Meteorological Society 87, 1961; T. von Karman, Proc. National
/// Academy of Sciences 34, 1948, as in ESDU 85020; IEC 61400-1:2019, annex C; EN 1991-1-4:2005,
/// annex B. The c that makes von Karman's integral sigma^2 and L the integral length is
/// (2 sqrt(pi) Gamma(1/3)/Gamma(5/6))^2 = 70.7801..., used here; it is printed as 70.8, which loses
/// 1.4e-4 of the variance.
///
/// Made by the functions below or from its elements; those that a kind does not name are ignored.
struct GustSpectrum {
  GustSpectrumKind kind = GustSpectrumKind::davenport;
  double surface_drag = 0.0;          // kappa, referred to the mean speed V; at least 0
  double turbulence_intensity = 0.0;  // I = sigma/V; at least 0
  double length_scale = 0.0;          // L, m; above 0

  friend bool operator==(const GustSpectrum&, const GustSpectrum&) = default;
};

GustSpectrum davenport_gusts(double surface_drag);
GustSpectrum von_karman_gusts(double turbulence_intensity, double length_scale);
/// At `height` (m) above ground, by kaimal_length_scale.
GustSpectrum kaimal_gusts(double turbulence_intensity, double height);
/// Intensity and length by the functions below, without orography.
GustSpectrum eurocode_gusts(double height, double roughness_length, double minimum_height);

/// @throws InvalidInput, naming `function`, for a kind that is none, or an element that its kind
/// uses and that is negative or not finite (a length: not above 0).
void validate(const GustSpectrum& gusts, std::string_view function);

/// One-sided in Hz, (m/s)^2/Hz, at frequency f > 0 (Hz) and mean speed V > 0 (m/s); integrates to
/// gust_variance. @throws InvalidInput for these and as validate.
double gust_spectrum(const GustSpectrum& gusts, double mean_speed, double frequency);

/// sigma^2, (m/s)^2. @throws InvalidInput as gust_spectrum.
double gust_variance(const GustSpectrum& gusts, double mean_speed);

/// Davenport's spectrum, (m/s)^2/Hz: S_v(f) = 4 kappa V^2 x^2/(f (1 + x^2)^(4/3)), x = 1200 f/V.
/// Integrates to 6 kappa V^2. @throws InvalidInput as gust_spectrum.
double davenport_spectrum(double surface_drag, double mean_speed, double frequency);

/// kappa = (0.4/ln(z/z0))^2 of a logarithmic profile of the mean wind, referred to the mean speed
/// at that height; sigma/V is sqrt(6 kappa) = 0.98/ln(z/z0). Both in m; z above z0 above 0.
/// @throws InvalidInput
double davenport_surface_drag(double height, double roughness_length);

/// L = 100 sqrt(z/30) m, at least 100 m (z up to 30 m), for von Karman's spectrum: the
/// Architectural Institute of Japan's Recommendations for Loads on Buildings. z > 0 (m).
/// @throws InvalidInput
double von_karman_length_scale(double height);

/// L = 8.1 Lambda, Lambda = 0.7 z up to z = 60 m and 42 m above (IEC 61400-1:2019, 6.3.1 and annex
/// C; the edition of 1999 had the end at 30 m). z > 0 (m). @throws InvalidInput
double kaimal_length_scale(double height);

/// L = 300 m (z/200)^a, a = 0.67 + 0.05 ln z0, and below z_min that of z_min (EN 1991-1-4, B.1).
/// Its terrains (table 4.1) have z0, z_min: open sea 0.003, 1; lakes, flat 0.01, 1; low vegetation
/// 0.05, 2; villages, forest 0.3, 5; towns 1, 10 m. The height ends at 200 m in the standard, not
/// here. All above 0 (m). @throws InvalidInput
double eurocode_length_scale(double height, double roughness_length, double minimum_height);

/// I = 1/ln(z/z0), below z_min that of z_min (EN 1991-1-4, 4.4, recommended k_I = 1, flat ground).
/// z and z_min above z0 above 0 (m). @throws InvalidInput
double eurocode_turbulence_intensity(double height, double roughness_length, double minimum_height);

}  // namespace boresight::plant
