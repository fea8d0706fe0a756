#pragma once
// One Gauss-Newton registration of a template model in one patch of a frame; Registrar decides what is put into it.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/vision/banded_cholesky.h"
#include "core/vision/frame_patch.h"
#include "core/vision/lens_term.h"
#include "core/vision/neighbour_weights.h"
#include "core/vision/registration.h"
#include "core/vision/row_sums.h"
#include "core/vision/smooth_field.h"
#include "core/vision/template_model.h"

namespace zerodrift::vision {

inline constexpr double registration_length_px = 100.0;  // scale of coordinates in the linear columns, for conditioning
inline constexpr double registration_lens_unit = 1e-8;   // of the lens column, likewise
inline constexpr int patch_margin_px = 18;               // around the region: rotation, blur and the spline's support

/// Of a frame, what is looked at to find a region of the template displaced by whole pixels.
inline Region patch_around(const Region& region, int dx_px, int dy_px) {
  return {region.x + dx_px - patch_margin_px, region.y + dy_px - patch_margin_px, region.width + 2 * patch_margin_px,
          region.height + 2 * patch_margin_px};
}

// An outline does not see a round target turn; what is still seen of it is reflected, and would move a point beside its
// middle.
inline constexpr double linear_prior_of_outline = 0.002;

class RegistrationSolver {
 public:
  /// `field` may be null: no smooth additive field is solved.
  RegistrationSolver(const TemplateModel& model, const FramePatch& patch, const SmoothField* field,
                     const RegistrationStart& start);

  /// On all pixels to the end; false when it ran away or too little was left.
  bool run();
  /// Whether light that falls on no target explained a part of it, if only on the way: something may lie there.
  bool was_partly_unlit() const { return m_was_partly_unlit; }
  /// On the first quarter of the pixels, which is spread evenly over the region.
  bool glance();
  /// Compares all pixels where the start puts them, with the light that suits most of them; false as run.
  bool compare();
  /// What was found on the `count` pixels used, without its uncertainty.
  Registration fit(int count) const;
  /// After run. The noise's effects on the model must be known.
  void tell_uncertainty(Registration& out) const;
  struct FieldStep {
    Eigen::Vector2d moved_px, noise_variance_px2;
  };
  /// After run without a field and tell_uncertainty: where a field would move the result to first order, and how well
  /// that would be known; empty where no field can be told.
  std::optional<FieldStep> step_with(const SmoothField& field, const Registration& told) const;
  /// Errors over their scale at each pixel of the region; NaN where the model has none.
  std::vector<float> residual_map(int width, int height) const;
  const Eigen::Vector2d& shift_px() const { return m_shift; }
  const Eigen::Matrix2d& linear() const { return m_linear; }
  /// To go on from here with images that are blurred alike.
  void hand_over(RegistrationStart& start) const;
  /// Covariance by which the frame is more blurred than the template.
  Eigen::Matrix2d extra_blur_px2() const;

 private:
  // Columns of the solve: motion, then what happens to the light.
  enum Column { tx, ty, axx, axy, ayx, ayy, bend, gain, gain_x, gain_y, offset, bxx, bxy, byy, column_count };
  static constexpr int motion_count = 7;
  static constexpr int light_count = column_count - motion_count;
  static_assert(light_count == registration_light_count);
  using Normal = Eigen::Matrix<double, column_count, column_count>;
  using Vector = Eigen::Matrix<double, column_count, 1>;
  using Rows = Eigen::Matrix<float, row_length, Eigen::Dynamic>;  // zero beyond column_count
  struct FieldPart {
    double prior = 0.0;
    BandedCholesky solved;
    Eigen::MatrixXd share;  // field coefficients that follow the columns: inverse(N_ff) N_fc
  };
  struct Scores;  // sums over tiles, for the uncertainty

  void fill_row(int k);
  Normal normal_of(const float* rows, const float* weights, int begin, int end) const;
  void sample(int count);
  void look_behind(int count);
  void predict(int count);
  void start_weights();
  void set_noise(double read_variance);
  void find_noise_model(int count);
  double scale_of_errors(int count);
  bool start_light(int count);
  bool step(int count);
  bool reweighted_step(int count, bool ask_neighbours);
  bool settle(int count);
  void weigh(int count, bool ask_neighbours);
  void leave_out_unlit(int count);
  void leave_out_gone();
  void choose_tukey();
  bool outdated(int count, bool light_only) const;
  bool prepare_normal(int count, bool light_only);
  bool eliminate(const SmoothField& field, const Eigen::VectorXf& weight, int count, FieldPart& out,
                 Normal& normal) const;
  Vector motion_gain() const;
  Vector right_of(const Eigen::VectorXf& weighted_errors, int count, double prior) const;
  bool solve(int count, bool light_only);
  void apply(const Vector& p);
  void tell_fit(int count, Registration& out) const;
  double tell_structure(int count, Registration& out) const;
  Scores scores_of_tiles(int count) const;
  template <typename PartOf>
  Eigen::Vector2d jackknife(const Scores& scores, PartOf part_of) const;
  Eigen::Vector2d variance_by_parts(const Scores& scores) const;
  double doubt_of_uneven(int count, const Registration& fit) const;
  void believe_turn(const Normal& inverse, double factor, Registration& out) const;

  // Fields that are aligned alike stand together: the order leaves no gaps.
  Eigen::Vector2d m_whole_px;
  Eigen::Vector2d m_shift;
  Eigen::Matrix2d m_linear;

  // The normal equations. Their matrix changes with the weights alone, so it is made anew only when those have changed;
  // where the steps end does not depend on it.
  struct Prepared {
    int count = 0;
    bool light_only = false;
    Eigen::VectorXf weight;
    double scale = 0.0, gain = 1.0, linear_prior = 0.0, lens_prior = 0.0;
    Normal normal;  // the field eliminated
    Eigen::LDLT<Normal> solved;
    FieldPart field;
  } m_prepared;

  const TemplateModel& m_model;
  const FramePatch& m_patch;
  const SmoothField* m_field;
  const std::vector<std::uint8_t>* m_doubted;
  double m_lens;  // 1 / px^2
  double m_tukey = 0.0;
  double m_scale = 1.0;
  double m_least_variance;  // of the errors: both pictures are rounded
  double m_last_step_px = 1.0;
  LensTerm m_prior;
  bool m_outline_alone;
  Eigen::Vector2d m_middle;
  Eigen::VectorXf m_field_levels;
  Eigen::Vector2f m_mean_place;  // of the pixels, in units of the linear columns' length
  Rows m_rows;
  Eigen::VectorXf m_frame, m_error;
  Eigen::VectorXf m_noise_weight, m_noise_root;  // 1 / variance of the noise, in units of that of middle grey
  Eigen::VectorXf m_robust, m_neighbours;        // what the error and the surroundings say of each pixel, 0 .. 1
  Eigen::VectorXf m_weight;                      // all three together
  std::vector<std::uint8_t> m_pixel_state;
  std::vector<float> m_scratch;
  std::vector<int> m_place;               // in the frame's spline, of the pixels sampled
  std::vector<float> m_fx, m_fy;          // fractions there
  std::vector<float> m_bend_x, m_bend_y;  // how the lens would move them
  Eigen::Matrix<double, light_count, 1> m_light;
  NeighbourWeights m_judge;
  int m_iterations = 0;
  bool m_partly_unlit = false;
  bool m_was_partly_unlit = false;
  bool m_all_pixels = false;  // after the glance
  bool m_light_known = false;
};

}  // namespace zerodrift::vision
