// The standard output within 80 columns, as terminals have them.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_NARROW_OUTPUT_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_NARROW_OUTPUT_H

#include <iostream>
#include <streambuf>
#include <string>

namespace ode_predictive_space::worlds
{
/// In columns, of what programs print.
constexpr std::size_t output_width = 80;

/// Characters on the screen: in UTF-8 all bytes but those that continue a character.
std::size_t width(const std::string &text);

/// A line broken into several of at most output_width columns, at blanks or after commas. The further ones begin where the text
/// does: after a gap of two blanks that ends a label, otherwise below the first letter. A text without blanks or commas stays as long as it is.
std::string folded(const std::string &line);

/// Folds all lines of a stream, as long as this lives. Nothing else may set the stream's buffer meanwhile. Lines go out when they
/// end, the last one also at the end of this.
class NarrowOutput : std::streambuf
{
public:
    explicit NarrowOutput(std::ostream &out = std::cout) : stream_(out), out_(out.rdbuf(this)) {}
    ~NarrowOutput() override;
    NarrowOutput(const NarrowOutput &) = delete;
    NarrowOutput &operator=(const NarrowOutput &) = delete;

    /// Writes the last line, which may lack its end.
    ///
    /// @return whether all that the stream was given since the beginning could be written.
    bool finish();

private:
    int_type overflow(int_type letter) override;
    int sync() override { return out_->pubsync(); }

    std::ostream &stream_;
    std::streambuf *out_;
    std::string line_;
};
} // namespace ode_predictive_space::worlds

#endif
