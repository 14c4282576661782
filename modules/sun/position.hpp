// SPDX-License-Identifier: MIT
//
// Where the sun stands: its azimuth and altitude as seen from a place on the Earth, by ERFA, the
// free edition of the IAU's SOFA routines. Apparent and topocentric: light time, aberration,
// precession, nutation and the observer's own place on the ellipsoid (WGS84) are in it, refraction
// as an extra. It agrees with the reference case of the Solar Position Algorithm of I. Reda and
// A. Andreas (NREL/TP-560-34302, 2004) to 0.0003 degrees and with the tests' table of another
// astronomy to less than 0.01 degrees.
//
// Not in it: polar motion, the observer's own velocity and UT1 - UTC, which is below 0.9 s; in that
// time the Earth turns by 0.004 degrees.
#pragma once

#include <optional>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/sun/calendar.hpp>

namespace gnomon::sun {

/// Geodetic, on WGS84.
struct Place {
    double latitude_rad = 0.0;   ///< -pi/2 .. pi/2, north positive
    double longitude_rad = 0.0;  ///< -pi .. pi, east positive
    double elevation_m = 0.0;    ///< above the ellipsoid
};

/// What light is bent by. No pressure: no refraction.
struct Air {
    double pressure_mbar = 1010.0;
    double temperature_c = 10.0;
};

struct SunPosition {
    double azimuth_rad = 0.0;   ///< from true north, clockwise (east is pi/2): 0 .. 2 pi
    double altitude_rad = 0.0;  ///< of the sun's centre above the horizon, as it is seen: refracted
    double airless_altitude_rad = 0.0;  ///< the same without refraction

    [[nodiscard]] double zenith_rad() const;
};

/// `delta_t_s` is TT - UT1 in seconds; without it, that of delta_t_s(). Cost: some 100 us.
[[nodiscard]] SunPosition sun_position(Instant utc, const Place& place, const Air& air = {},
                                       std::optional<double> delta_t_s = std::nullopt);

/// By how much refraction lifts the sun's centre, from its altitude without: formula 42 of the
/// Solar Position Algorithm, after J. Meeus. Nothing where the whole sun is below the horizon.
[[nodiscard]] double refraction_rad(double airless_altitude_rad, const Air& air);

/// TT - UT1 in seconds: polynomials of F. Espenak and J. Meeus ("Five Millennium Canon of Solar
/// Eclipses", 2006) for 1941 to 2150. They are seconds off by 2026, which turns the sun by less
/// than 0.0001 degrees.
[[nodiscard]] double delta_t_s(Instant utc);

/// The unit vector towards the sun in a plan: x to the right, y up the plan, z towards the zenith.
/// `north_rad`: clockwise from the plan's own y to true north.
[[nodiscard]] glm::dvec3 towards_sun(double azimuth_rad, double altitude_rad,
                                     double north_rad = 0.0);

}  // namespace gnomon::sun
