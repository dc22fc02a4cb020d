/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpXYStage.h
 * \brief A planar stage with friction, stiction, lag and delay.
 */
#ifndef vpXYStage_h
#define vpXYStage_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <array>
#include <limits>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_simulation
 * \brief One axis of a vpXYStage. Units are arbitrary: a length L (px, m), a time T (frame, s) and a force F. With mass
 * 1, forces are accelerations, L/T^2.
 */
struct VISP_EXPORT vpXYStageAxis {
  double mass = 1.;             //!< Moved mass, F T^2/L, > 0.
  double viscous = 0.;          //!< Viscous friction coefficient, F T/L, >= 0.
  double coulomb = 0.;          //!< Coulomb friction, F, >= 0.
  double stiction = 0.;         //!< Breakaway force, F, >= #coulomb.
  double stribeckVelocity = 1.; //!< Velocity over which the friction falls from stiction to Coulomb, L/T, > 0.
  double viscousRise = 0.;      //!< Relative increase of #viscous beyond #viscousRiseFrom, >= -1.
  double viscousRiseFrom = 0.;  //!< Position where the increase begins, L.
  double lag = 0.;              //!< Time constant from commanded to acting force, T, >= 0.
  double delay = 0.;            //!< Dead time of the command, T, >= 0.
  double maxVelocity = std::numeric_limits<double>::infinity(); //!< Speed limit, L/T, > 0.

  //! \return Friction force at a velocity > 0 and a position, F: the steady force that maintains this velocity.
  [[nodiscard]] double friction(double velocity, double position) const;
  /*!
   * \param name : Name of the axis, for the message.
   * \throw vpException (badValue) naming axis, field and value if one is out of range or not finite.
   */
  void validate(const char *name) const;
};

//! \ingroup group_simulation
//! \brief Both axes of a vpXYStage.
struct VISP_EXPORT vpXYStageSpec {
  vpXYStageAxis x; //!< Axis along the rows of the image.
  vpXYStageAxis y; //!< Axis along the columns of the image.

  /*!
   * The linear motors with dry bearings of thesis chapter 7, units px and frame (1/1600 s), mass 1: viscous friction
   * 0.02, 30 % more beyond the fifth cell; Coulomb 0.08, stiction 0.12, Stribeck velocity 0.3 px/frame, lag 0.3 frame.
   * No delay: the 1.28 frames of that system are the camera's. The thesis does not give these numbers: they are chosen.
   * Those fitted to all that it states of its figures are in lab/printing/vpPrintFit.
   */
  [[nodiscard]] static vpXYStageSpec thesis();
  //! \throw vpException (badValue) naming axis, field and value if one is out of range or not finite.
  void validate() const;
};

/*!
 * \class vpXYStage
 * \ingroup group_simulation
 * \brief Simulates a stage with two independent axes driven by forces; with mass 1, by accelerations.
 *
 * Per axis, with the command u constant in each step:
 * \verbatim
   tau f' = u(t - d) - f,   m v' = f - sgn(v) (Fc + (Fs - Fc) exp(-(v / vs)^2) + Fv |v|)
   \endverbatim
 * A resting axis stays at rest while |f| <= Fs, and a moving one comes to rest when its velocity crosses 0. A
 * step is split where a delayed command changes and integrated in at least 32 parts: the lag exactly, the friction by
 * the midpoint rule; see catchXYStage for the errors. The same commands give the same motion, bit for bit.
 *
 * \code
 * vpXYStage stage(vpXYStageSpec::thesis());
 * for (int frame = 0; frame < 100; ++frame) {
 *   stage.step(1., {0.2, 0.}); // after a while, about 6 px/frame
 * }
 * const vpXYStage::State &state = stage.state();
 * const vpProductPattern product{vpProductPatternSpec()};
 * product.render(state.position[0], state.position[1], state.velocity[0], state.velocity[1], 100, image);
 * \endcode
 */
class VISP_EXPORT vpXYStage
{
public:
  using Pair = std::array<double, 2>; //!< x, y.

  //! \brief State of the stage, except pending commands.
  struct State {
    double time = 0.;                          //!< Time since reset(), T.
    Pair position{{0., 0.}};                   //!< Positions, L.
    Pair velocity{{0., 0.}};                   //!< Velocities, L/T.
    Pair force{{0., 0.}};                      //!< Acting forces, after delay and lag, F.
    std::array<bool, 2> resting{{true, true}}; //!< True for an axis held by stiction.
  };

  //! \throw vpException (badValue), see vpXYStageSpec::validate().
  explicit vpXYStage(const vpXYStageSpec &spec);

  /*!
   * Moves for a duration. Does not allocate.
   * \param dt : Duration, T; > 0, at least 1/1000 of the longest delay and at most 1e6.
   * \param command : Forces, F, at most 1e12, from now until the next call; they act after the delay.
   * \return state() afterwards.
   * \throw vpException (badValue) naming an argument that is out of range or not finite; nothing has moved then.
   */
  const State &step(double dt, const Pair &command);
  //! Current state.
  [[nodiscard]] const State &state() const { return m_state; }
  //! Parameters of the stage.
  [[nodiscard]] const vpXYStageSpec &spec() const { return m_spec; }
  //! Resets to rest at a position, L, at time 0, without pending commands. \throw vpException unless at most 1e12.
  void reset(const Pair &position = {{0., 0.}});

private:
  //! \brief A command and when it was given.
  struct Given {
    double time;
    Pair command;
  };
  void stepAxis(std::size_t axis, double dt);
  void integrate(std::size_t axis, double command, double duration, int parts);
  void part(std::size_t axis, double command, double h);

  vpXYStageSpec m_spec;
  std::array<vpXYStageAxis, 2> m_axes;
  State m_state;
  std::vector<Given> m_given; // active and pending commands, oldest first; capacity reserved
};

END_VISP_NAMESPACE
#endif
