#pragma once

namespace pedicel::cosserat {

struct Material {
  double youngs_modulus = 2.0e7;  ///< Pa, > 0
  double poisson_ratio = 0.35;    ///< 1, in (-1, 0.5]
  double density = 700.0;         ///< kg/m3, > 0
  double damping_time = 0.01;  ///< s, Kelvin-Voigt: stress = E (strain + damping_time strain rate)
};

/// What a cross-section of one material does per unit length. Axes 1 and 2 lie in the section,
/// axis 3 along the rod. Index 1 of a bending stiffness means bending ABOUT axis 1.
struct Section {
  double shear1 = 0.0, shear2 = 0.0;                      ///< N, k G A along axes 1 and 2
  double axial = 0.0;                                     ///< N, E A
  double bend1 = 0.0, bend2 = 0.0;                        ///< N m2, E I about axes 1 and 2
  double twist = 0.0;                                     ///< N m2, G J
  double mass = 0.0;                                      ///< kg/m
  double inertia1 = 0.0, inertia2 = 0.0, inertia3 = 0.0;  ///< kg m, rho I about the axes
};

/// Shear coefficients: Cowper, "The shear coefficient in Timoshenko's beam theory", J. Appl. Mech.
/// 33 (1966). Torsion constants: Timoshenko & Goodier, Theory of Elasticity, chapter 10.
Section circle_section(double radius, const Material& material);

/// Half-axes: `half1` along axis 1, `half2` along axis 2 (m).
Section ellipse_section(double half1, double half2, const Material& material);

/// Full extents: `extent1` along axis 1, `extent2` along axis 2 (m).
Section rectangle_section(double extent1, double extent2, const Material& material);

}  // namespace pedicel::cosserat
