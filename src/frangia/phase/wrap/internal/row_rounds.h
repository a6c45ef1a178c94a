#pragma once

namespace frangia {

/// The rows of an image in rounds, each spread evenly over the image and with about twice the rows
/// of the one before; no row comes twice.
class RowRounds {
 public:
  /// The first round has at most `first` pixels; all rounds together at most about `most`.
  RowRounds(int width, int height, double first, double most) : height_(height) {
    const double pixels = static_cast<double>(width) * height;
    while (pixels / stride_ > first)
      stride_ *= 2;
    while (stride_ >> count_ > 0 && (count_ == 0 || 2.0 * pixels / (stride_ >> count_) <= most))
      ++count_;
  }
  [[nodiscard]] int count() const { return count_; }
  template <typename Row>
  void for_each_row(int round, const Row& row) const {
    const int step = stride_ >> round;
    if (step == 1) {  // what the rounds before left out
      for (int y = 0; y < height_; y += stride_)
        row(y);
      return;
    }
    for (int y = step / 2; y < height_; y += step)
      row(y);
  }

 private:
  int height_;
  int stride_ = 1;
  int count_ = 0;
};

}  // namespace frangia
