// SPDX-License-Identifier: MIT
#include <gnomon/sun/position.hpp>

#include <cmath>
#include <numbers>

#include <erfa.h>
#include <erfam.h>

namespace gnomon::sun {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;
constexpr double epoch_jd = 2440587.5;  // 1970-01-01 00:00

struct JulianDate {
    double day = 0.0;  // ends with .5
    double fraction = 0.0;
};

JulianDate julian_date(Instant utc) {
    const auto day = std::chrono::floor<std::chrono::days>(utc);
    return {epoch_jd + static_cast<double>(day.time_since_epoch().count()),
            static_cast<double>((utc - day).count()) / 86400.0};
}

double decimal_year(Instant utc) { return 2000.0 + (julian_date(utc).day - 2451544.5) / 365.25; }

// From the Earth's centre to the sun's, au, equator and equinox of date, as its light arrives. Also
// gives the matrix of precession and nutation.
glm::dvec3 apparent_sun(const JulianDate& tt, double (&true_from_celestial)[3][3]) {
    double heliocentric[2][3];
    double barycentric[2][3];
    eraEpv00(tt.day, tt.fraction, heliocentric, barycentric);
    // Where the sun was when the light left it.
    const double travel_days = eraPm(heliocentric[0]) * ERFA_AULT / ERFA_DAYSEC;
    double heliocentric_then[2][3];
    double barycentric_then[2][3];
    eraEpv00(tt.day, tt.fraction - travel_days, heliocentric_then, barycentric_then);
    double natural[3];
    for (int i = 0; i < 3; ++i) {
        natural[i] = barycentric_then[0][i] - heliocentric_then[0][i] - barycentric[0][i];
    }
    double distance_au = 0.0;
    double unit[3];
    eraPn(natural, &distance_au, unit);
    double velocity[3];  // of the Earth, in units of that of light
    double square = 0.0;
    for (int i = 0; i < 3; ++i) {
        velocity[i] = barycentric[1][i] / ERFA_DC;
        square += velocity[i] * velocity[i];
    }
    double proper[3];
    eraAb(unit, velocity, distance_au, std::sqrt(1.0 - square), proper);
    eraPnm06a(tt.day, tt.fraction, true_from_celestial);
    double of_date[3];
    eraRxp(true_from_celestial, proper, of_date);
    return glm::dvec3(of_date[0], of_date[1], of_date[2]) * distance_au;
}

}  // namespace

double SunPosition::zenith_rad() const { return pi / 2.0 - altitude_rad; }

SunPosition sun_position(Instant utc, const Place& place, const Air& air,
                         std::optional<double> delta_t) {
    const JulianDate ut1 = julian_date(utc);
    const JulianDate tt{ut1.day, ut1.fraction + delta_t.value_or(delta_t_s(utc)) / ERFA_DAYSEC};
    double true_from_celestial[3][3];
    const glm::dvec3 sun_m = apparent_sun(tt, true_from_celestial) * ERFA_DAU;
    const double sidereal_rad =
        eraGst06(ut1.day, ut1.fraction, tt.day, tt.fraction, true_from_celestial);

    // In the Earth's own axes, as seen from the place: that is the parallax.
    double place_m[3] = {};
    eraGd2gc(ERFA_WGS84, place.longitude_rad, place.latitude_rad, place.elevation_m, place_m);
    const double c = std::cos(sidereal_rad);
    const double s = std::sin(sidereal_rad);
    const glm::dvec3 seen =
        glm::dvec3(c * sun_m.x + s * sun_m.y, c * sun_m.y - s * sun_m.x, sun_m.z) -
        glm::dvec3(place_m[0], place_m[1], place_m[2]);

    const double cos_lat = std::cos(place.latitude_rad);
    const double sin_lat = std::sin(place.latitude_rad);
    const double cos_lon = std::cos(place.longitude_rad);
    const double sin_lon = std::sin(place.longitude_rad);
    const double outward = cos_lon * seen.x + sin_lon * seen.y;  // from the Earth's axis
    const double east = cos_lon * seen.y - sin_lon * seen.x;
    const double north = cos_lat * seen.z - sin_lat * outward;
    const double up = sin_lat * seen.z + cos_lat * outward;

    SunPosition position;
    position.azimuth_rad = std::atan2(east, north);
    if (position.azimuth_rad < 0.0) position.azimuth_rad += 2.0 * pi;
    position.airless_altitude_rad = std::atan2(up, std::hypot(east, north));
    position.altitude_rad =
        position.airless_altitude_rad + refraction_rad(position.airless_altitude_rad, air);
    return position;
}

double refraction_rad(double airless_altitude_rad, const Air& air) {
    const double altitude_deg = airless_altitude_rad / degree;
    constexpr double sun_radius_deg = 0.26667;
    constexpr double at_horizon_deg = 0.5667;
    if (altitude_deg < -(sun_radius_deg + at_horizon_deg)) return 0.0;
    return air.pressure_mbar / 1010.0 * 283.0 / (273.0 + air.temperature_c) * 1.02 /
           (60.0 * std::tan((altitude_deg + 10.3 / (altitude_deg + 5.11)) * degree)) * degree;
}

double delta_t_s(Instant utc) {
    const double year = decimal_year(utc);
    if (year < 1961.0) {
        const double t = year - 1950.0;
        return 29.07 + t * (0.407 + t * (-1.0 / 233.0 + t / 2547.0));
    }
    if (year < 1986.0) {
        const double t = year - 1975.0;
        return 45.45 + t * (1.067 + t * (-1.0 / 260.0 - t / 718.0));
    }
    const double t = year - 2000.0;
    if (year < 2005.0) {
        return 63.86 + t * (0.3345 + t * (-0.060374 +
                                          t * (0.0017275 + t * (0.000651814 + t * 0.00002373599))));
    }
    if (year < 2050.0) return 62.92 + t * (0.32217 + t * 0.005589);
    const double centuries = (year - 1820.0) / 100.0;
    return -20.0 + 32.0 * centuries * centuries - 0.5628 * (2150.0 - year);
}

glm::dvec3 towards_sun(double azimuth_rad, double altitude_rad, double north_rad) {
    const double bearing = azimuth_rad + north_rad;
    const double level = std::cos(altitude_rad);
    return {level * std::sin(bearing), level * std::cos(bearing), std::sin(altitude_rad)};
}

}  // namespace gnomon::sun
