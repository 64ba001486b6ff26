#pragma once
#include <string>
#include <vector>

#include "dashpot/export/c/c_block.h"
#include "dashpot/export/c_subset/c_syntax.h"
#include "dashpot/export/onnx/graph.h"

namespace dashpot::trace {

/// The calculation of a block's C code, sample by sample, as a graph. Its state is the whole
/// damper_model, number by number. Throws Error where the code cannot become a graph.
class Calculation {
 public:
  /// `first`: in place of block.step at the sample at which a run begins, behind damper_reset.
  Calculation(const CBlock& block, const std::string& first);

  struct Outputs {
    std::vector<Node> commands, state;
  };
  const Outputs& step() const { return step_; }
  const Outputs& first() const { return first_; }
  /// The places in the state on which the commands depend, now or later.
  const std::vector<std::size_t>& used() const { return used_; }
  std::size_t state_size() const { return state_size_; }
  Node input(std::size_t place) { return graph.input(place); }
  Node state_input(std::size_t place) { return graph.input(input_size_ + place); }
  /// The numbers of the state after damper_reset where all inputs are zero.
  std::vector<double> at_rest();

  Graph graph;

 private:
  std::vector<Node> inputs();
  Outputs called(const std::vector<const char*>& functions, const std::vector<Node>& given,
                 const std::vector<Node>& state, bool unrolls = false);
  bool trace_step();
  void find_used();

  const CProgram program_;
  std::size_t input_size_ = 0, command_size_ = 0, state_size_ = 0;
  Outputs first_, step_;
  std::vector<Node> fixed_;  ///< of the state: what stays constant, or its input
  std::vector<std::size_t> used_;
};

}  // namespace dashpot::trace
