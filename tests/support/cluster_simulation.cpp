#include "support/cluster_simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <random>
#include <vector>

namespace etendue::test {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kSlowFactor = 10;
constexpr double kPollInterval = 0.25;  // seconds between two looks at ranks without work

struct Answer {
  double time = 0;  // at which the rank has rendered it, then at which rank 0 has received it
  bool is_received = false;
  int rank = 0;
  cluster::Piece piece;

  friend bool operator>(const Answer& a, const Answer& b) { return a.time > b.time; }
};

class Simulation {
 public:
  explicit Simulation(const SimulatedJob& job)
      : job_(job), random_(job.seed), schedule_(job.ranks, job.samples, {}, job.options) {
    std::normal_distribution<double> spread(0, job.speed_spread);
    std::exponential_distribution<double> life(job.lifetime > 0 ? 1 / job.lifetime : 1);
    for (int rank = 0; rank < job.ranks; ++rank) {
      seconds_per_sample_.push_back(job.seconds_per_sample * std::exp(spread(random_)));
      deaths_.push_back(rank > 0 && job.lifetime > 0 ? life(random_) : kNever);
      idle_.push_back(rank);
    }
  }

  SimulatedRun run() {
    // A job that does not end is a failure of the schedule.
    const double limit = 1e5;
    while (!schedule_.is_finished() && now_ < limit) {
      give_work();
      if (!answers_.empty() && answers_.top().time <= now_ + kPollInterval) {
        const Answer answer = answers_.top();
        answers_.pop();
        now_ = std::max(now_, answer.time);
        if (answer.is_received)
          handle(answer);
        else
          transfer(answer);
      } else {
        now_ += kPollInterval;
      }
    }
    return results();
  }

 private:
  bool occurs(double probability) { return std::uniform_real_distribution<double>()(random_) < probability; }

  void give_work() {
    std::erase_if(idle_, [&](int rank) {
      const auto piece = schedule_.next(rank, now_);
      if (piece) begin(rank, *piece);
      return piece.has_value();
    });
  }

  void begin(int rank, const cluster::Piece& piece) {
    const auto index = static_cast<size_t>(rank);
    double rendering = seconds_per_sample_[index] * piece.samples.size();
    if (occurs(job_.slow_pieces)) rendering *= kSlowFactor;
    const double rendered = now_ + job_.latency + rendering;
    if (rendered > deaths_[index]) return;  // no answer
    answers_.push({rendered, rank == 0, rank, piece});
  }

  // Results cross the link one after the other.
  void transfer(Answer answer) {
    const double duration = job_.bytes_per_result / job_.bytes_per_second;
    link_free_ = std::max(answer.time + job_.latency, link_free_) + duration;
    link_used_ += duration;
    answer.time = link_free_;
    answer.is_received = true;
    answers_.push(answer);
  }

  void handle(const Answer& answer) {
    ++run_.results;
    idle_.push_back(answer.rank);
    if (answer.rank > 0) run_.bytes += job_.bytes_per_result;
    if (answer.rank > 0 && occurs(job_.damaged_results)) return schedule_.reject(answer.rank);
    const bool is_new = schedule_.complete(answer.rank, answer.piece.id, now_);
    give_work();
    if (!is_new) return;
    run_.merged_samples += answer.piece.samples.size();
    useful_ += seconds_per_sample_[static_cast<size_t>(answer.rank)] * answer.piece.samples.size();
    now_ += job_.merge_seconds;
    merging_ += job_.merge_seconds;
    schedule_.set_merge_seconds(job_.merge_seconds);
  }

  SimulatedRun results() {
    run_.is_complete = schedule_.is_finished();
    run_.seconds = now_;
    double available = 0;
    for (const double death : deaths_) available += std::min(death, now_);
    run_.utilisation = useful_ / available;
    run_.merging = merging_ / now_;
    run_.receiving = link_used_ / now_;
    run_.repeated = schedule_.repeated_pieces();
    run_.damaged = schedule_.damaged_results();
    run_.dead_ranks = static_cast<int>(std::ranges::count_if(deaths_, [&](double t) { return t < now_; }));
    return run_;
  }

  const SimulatedJob& job_;
  std::mt19937_64 random_;
  cluster::WorkSchedule schedule_;
  std::vector<double> seconds_per_sample_, deaths_;  // by rank
  std::vector<int> idle_;
  std::priority_queue<Answer, std::vector<Answer>, std::greater<>> answers_;
  double now_ = 0, link_free_ = 0, link_used_ = 0, merging_ = 0, useful_ = 0;
  SimulatedRun run_;
};

}  // namespace

SimulatedRun simulate(const SimulatedJob& job) { return Simulation(job).run(); }

}  // namespace etendue::test
