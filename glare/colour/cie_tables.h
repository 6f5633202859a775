// The CIE's observers and daylight as a table of facts: 380 to 780 nm, every 5 nm.
#pragma once

#include <array>

namespace seaglare::glare {

inline constexpr int cie_first_wavelength_nm = 380;
inline constexpr int cie_step_wavelength_nm = 5;
inline constexpr int cie_samples = 81;
inline constexpr int cie_last_wavelength_nm =
    cie_first_wavelength_nm + (cie_samples - 1) * cie_step_wavelength_nm;

// One wavelength. Sources: CIE 018:2019; 1931 2-degree observer doi 10.25039/CIE.DS.xvudnb9b (its y is V(lambda));
// illuminant D65 doi 10.25039/CIE.DS.hjfjmt59, 100 at 560 nm; V'(lambda) of the CIE 1951 scotopic observer.
struct CieSample {
    double x_bar;
    double y_bar;
    double z_bar;
    double d65;
    double v_prime;
};

extern const std::array<CieSample, cie_samples> cie_table;

}  // namespace seaglare::glare
