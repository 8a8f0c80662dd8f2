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

// A result, or the sum of a collector, in the order of its events.
struct Event {
  enum class Kind { rendered, arrived, received, summed };
  // rendered: the rank has the result. arrived: rank 0 has the notice of the collector. received: rank 0 has a result or
  // a sum. summed: the collector begins to send its sum.
  Kind kind = Kind::rendered;
  double time = 0;
  int rank = 0;
  cluster::Piece piece = {};
  bool is_sum = false;
  uint32_t samples = 0;  // of a sum
  double useful = 0;     // seconds of rendering in a sum

  friend bool operator>(const Event& a, const Event& b) { return a.time > b.time; }
};

// What a rank has as a collector; that of rank 0 is its link.
struct Receiver {
  double link_free = 0, free = 0;  // times from which it can receive and add the next result
  uint32_t samples = 0;            // added and not sent
  double useful = 0;
};

class Simulation {
 public:
  explicit Simulation(const SimulatedJob& job)
      : job_(job),
        random_(job.seed),
        schedule_(job.ranks, job.samples, {}, job.options),
        receivers_(static_cast<size_t>(job.ranks)),
        current_(static_cast<size_t>(job.ranks)) {
    std::normal_distribution<double> spread(0, job.speed_spread);
    std::exponential_distribution<double> life(job.lifetime > 0 ? 1 / job.lifetime : 1);
    for (int rank = 0; rank < job.ranks; ++rank) {
      seconds_per_sample_.push_back(job.seconds_per_sample * std::exp(spread(random_)));
      deaths_.push_back(rank > 0 && job.lifetime > 0 ? life(random_) : kNever);
    }
  }

  SimulatedRun run() {
    // A job that does not end is a failure of the schedule.
    const double limit = 1e5;
    while (!schedule_.is_finished() && now_ < limit) {
      collect();
      give_work();
      if (!events_.empty() && events_.top().time <= now_ + kPollInterval) {
        const Event event = events_.top();
        events_.pop();
        // Other ranks do not wait for rank 0.
        if (event.kind == Event::Kind::rendered) {
          transfer_result(event);
          continue;
        }
        if (event.kind == Event::Kind::summed) {
          receive(event);
          continue;
        }
        now_ = std::max(now_, event.time);
        if (event.kind == Event::Kind::arrived)
          handle_arrival(event);
        else
          handle(event);
      } else {
        now_ += kPollInterval;
      }
    }
    return results();
  }

 private:
  bool occurs(double probability) { return std::uniform_real_distribution<double>()(random_) < probability; }
  Receiver& receiver(int rank) { return receivers_[static_cast<size_t>(rank)]; }
  bool is_dead(int rank, double time) const { return deaths_[static_cast<size_t>(rank)] < time; }

  void give_work() {
    for (int rank = 0; rank < job_.ranks; ++rank) give_work(rank);
  }

  void give_work(int rank) {
    if (const auto piece = schedule_.next(rank, now_)) begin(rank, *piece);
  }

  void begin(int rank, const cluster::Piece& piece) {
    const auto index = static_cast<size_t>(rank);
    current_[index] = piece;
    double rendering = seconds_per_sample_[index] * piece.samples.size();
    if (occurs(job_.slow_pieces)) rendering *= kSlowFactor;
    events_.push({.time = now_ + job_.latency + rendering, .rank = rank, .piece = piece});
  }

  // The time at which the message has crossed the link of its receiver.
  double cross_link(int to, double time) {
    const double duration = job_.bytes_per_result / job_.bytes_per_second;
    Receiver& r = receiver(to);
    r.link_free = std::max(time + job_.latency, r.link_free) + duration;
    if (to == 0) link_used_ += duration;
    return r.link_free;
  }

  // Over the link to rank 0.
  void receive(Event event) {
    event.kind = Event::Kind::received;
    if (event.rank > 0) {
      event.time = cross_link(0, event.time);
      run_.bytes += job_.bytes_per_result;
    }
    events_.push(event);
  }

  void transfer_result(Event event) {
    const cluster::Piece& current = current_[static_cast<size_t>(event.rank)];
    if (is_dead(event.rank, event.time) || current.id != event.piece.id ||
        current.collector != event.piece.collector)  // abandoned
      return;
    const int collector = event.piece.collector;
    if (collector == 0) return receive(event);
    const double received = std::max(cross_link(collector, event.time), receiver(collector).free);
    if (is_dead(collector, received)) return;
    event.kind = Event::Kind::arrived;
    event.time = received + job_.latency;
    events_.push(event);
  }

  // Rank 0 decides about a result at a collector, which adds it.
  void handle_arrival(const Event& event) {
    ++run_.results;
    const int collector = event.piece.collector;
    if (!schedule_.is_at(event.rank, collector)) return;
    if (occurs(job_.damaged_results)) return schedule_.reject(event.rank);
    const bool is_new = schedule_.complete(event.rank, event.piece.id, now_);
    give_work(event.rank);
    if (!is_new) return;
    Receiver& r = receiver(collector);
    r.free = std::max(r.free, now_ + job_.latency) + job_.merge_seconds;
    r.samples += event.piece.samples.size();
    r.useful += seconds_per_sample_[static_cast<size_t>(event.rank)] * event.piece.samples.size();
  }

  void collect() {
    while (const auto late = schedule_.late_collector(now_)) {
      schedule_.retire(*late);
      receiver(*late).samples = 0;
      receiver(*late).useful = 0;
    }
    while (const auto collector = schedule_.next_to_collect(now_)) {
      Receiver& r = receiver(*collector);
      const double begun = std::max(r.free, now_ + job_.latency);
      const Event sum{.kind = Event::Kind::summed,
                      .time = begun,
                      .rank = *collector,
                      .is_sum = true,
                      .samples = r.samples,
                      .useful = r.useful};
      r.samples = 0;
      r.useful = 0;
      if (!is_dead(*collector, begun)) events_.push(sum);
    }
  }

  // Rank 0 has a result or a sum.
  void handle(const Event& event) {
    ++run_.results;
    uint32_t samples = event.samples;
    double useful = event.useful;
    if (event.is_sum) {
      if (!schedule_.deliver(event.rank)) return;
    } else {
      if (event.rank > 0 && occurs(job_.damaged_results)) return schedule_.reject(event.rank);
      const bool is_new = schedule_.complete(event.rank, event.piece.id, now_);
      give_work(event.rank);
      if (!is_new) return;
      samples = event.piece.samples.size();
      useful = seconds_per_sample_[static_cast<size_t>(event.rank)] * samples;
    }
    run_.merged_samples += samples;
    useful_ += useful;
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
    run_.collectors = schedule_.collectors();
    run_.retired_collectors = schedule_.retired_collectors();
    run_.repeated = schedule_.repeated_pieces();
    run_.damaged = schedule_.damaged_results();
    run_.dead_ranks = static_cast<int>(std::ranges::count_if(deaths_, [&](double t) { return t < now_; }));
    return run_;
  }

  const SimulatedJob& job_;
  std::mt19937_64 random_;
  cluster::WorkSchedule schedule_;
  std::vector<Receiver> receivers_;                  // by rank
  std::vector<cluster::Piece> current_;              // the last piece of each rank
  std::vector<double> seconds_per_sample_, deaths_;  // by rank
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  double now_ = 0, link_used_ = 0, merging_ = 0, useful_ = 0;
  SimulatedRun run_;
};

}  // namespace

SimulatedRun simulate(const SimulatedJob& job) { return Simulation(job).run(); }

}  // namespace etendue::test
