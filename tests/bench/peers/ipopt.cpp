// Ipopt: the epigraph form of min_tolerance with exact first derivatives and its limited-memory Hessian.

#include <coin/IpIpoptApplication.hpp>
#include <coin/IpTNLP.hpp>

#include <algorithm>
#include <array>
#include <limits>

#include "tests/bench/peers/distance_model.hpp"

namespace bladefit::bench {
namespace {

/// Variables (x, s): the least s with d_i - s w_i <= 0 and -d_i - s w_i <= 0.
class ToleranceProgram : public Ipopt::TNLP {
 public:
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;

  ToleranceProgram(const TextbookSurface& surface, int outward, const FitProblem& problem)
      : model_(surface, outward, problem), weights_(problem.weights) {}

  [[nodiscard]] Pose pose() const { return model_.pose_at(solution_.data()); }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries,
                    IndexStyleEnum& style) override {
    n = kVariables;
    m = static_cast<Index>(2 * weights_.size());
    jacobian_entries = n * m;
    hessian_entries = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* x_l, Number* x_u, Index m, Number* g_l, Number* g_u) override {
    std::fill_n(x_l, n, -kInfinity);
    std::fill_n(x_u, n, kInfinity);
    std::fill_n(g_l, m, -kInfinity);
    std::fill_n(g_u, m, 0.0);
    return true;
  }

  bool get_starting_point(Index n, bool /*init_x*/, Number* x, bool /*init_z*/, Number* /*z_l*/, Number* /*z_u*/,
                          Index /*m*/, bool /*init_lambda*/, Number* /*lambda*/) override {
    std::fill_n(x, n, 0.0);
    model_.evaluate(x);
    for (std::size_t i = 0; i < weights_.size(); ++i) x[6] = std::max(x[6], std::abs(distance(i)) / weights_[i]);
    return true;
  }

  bool eval_f(Index n, const Number* x, bool /*new_x*/, Number& value) override {
    value = x[n - 1];
    return true;
  }

  bool eval_grad_f(Index n, const Number* /*x*/, bool /*new_x*/, Number* gradient) override {
    std::fill_n(gradient, n, 0.0);
    gradient[n - 1] = 1.0;
    return true;
  }

  bool eval_g(Index n, const Number* x, bool /*new_x*/, Index /*m*/, Number* g) override {
    model_.evaluate(x);
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const double d = distance(i), limit = x[n - 1] * weights_[i];
      g[2 * i] = d - limit;
      g[2 * i + 1] = -d - limit;
    }
    return true;
  }

  bool eval_jac_g(Index n, const Number* x, bool /*new_x*/, Index m, Index /*entries*/, Index* rows, Index* columns,
                  Number* values) override {
    if (values == nullptr) {
      for (Index k = 0; k < n * m; ++k) {
        rows[k] = k / n;
        columns[k] = k % n;
      }
      return true;
    }
    model_.evaluate(x);
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      for (const double sign : {1.0, -1.0}) {
        for (Eigen::Index k = 0; k < 6; ++k) *values++ = sign * model_.jacobian()(static_cast<Eigen::Index>(i), k);
        *values++ = -weights_[i];
      }
    }
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn /*status*/, Index n, const Number* x, const Number* /*z_l*/,
                         const Number* /*z_u*/, Index /*m*/, const Number* /*g*/, const Number* /*lambda*/,
                         Number /*value*/, const Ipopt::IpoptData* /*data*/,
                         Ipopt::IpoptCalculatedQuantities* /*quantities*/) override {
    std::copy_n(x, n, solution_.begin());
  }

 private:
  static constexpr Index kVariables = 7;
  static constexpr Number kInfinity = 2e19;  // what Ipopt takes for it

  [[nodiscard]] double distance(std::size_t i) const { return model_.distances()[static_cast<Eigen::Index>(i)]; }

  DistanceModel model_;
  const std::vector<double>& weights_;
  std::array<double, kVariables> solution_{};
};

Pose ipopt_min_tolerance(const TextbookSurface& surface, int outward, const FitProblem& problem) {
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  application->Options()->SetStringValue("hessian_approximation", "limited-memory");
  application->Options()->SetStringValue("sb", "yes");
  application->Options()->SetStringValue("mu_strategy", "adaptive");
  application->Options()->SetIntegerValue("print_level", 0);
  application->Options()->SetIntegerValue("max_iter", 500);
  application->Options()->SetNumericValue("tol", 1e-11);
  application->Initialize();
  const Ipopt::SmartPtr<ToleranceProgram> program = new ToleranceProgram(surface, outward, problem);
  application->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(Ipopt::GetRawPtr(program)));
  return program->pose();
}

}  // namespace

std::vector<Peer> ipopt_peers(const UnitSurface& surface, int outward) {
  const auto textbook = std::make_shared<TextbookSurface>(surface);
  Peer peer;
  peer.name = "Ipopt";
  peer.min_tolerance = [textbook, outward](const FitProblem& problem) {
    return ipopt_min_tolerance(*textbook, outward, problem);
  };
  return {peer};
}

}  // namespace bladefit::bench
