#include "calibrate_board_verb.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/calibrate/board/write_board_pdf.h"
#include "frangia/core/error.h"
#include "frangia/core/text.h"

#include "option_values.h"
#include "print_text.h"

namespace frangia {
namespace {

struct BoardArguments {
  std::filesystem::path output;
  BoardKind kind = BoardKind::Checkerboard;
  std::string paper = "a4";
  std::vector<int> corners = {10, 7};
  double square_mm = 0.0;
  double marker_mm = 0.0;
  std::string dictionary = "DICT_5X5_100";
  int first_id = 0;
  bool legacy_layout = false;
};

void calibrate_board_verb(const BoardArguments& arguments, Terminal& terminal) {
  require(lowercase_extension(arguments.output) == ".pdf",
          "a board is written as .pdf, which prints at true scale; give a file name that ends with "
          ".pdf");
  const bool circles = arguments.kind == BoardKind::Circles;
  const bool charuco = arguments.kind == BoardKind::Charuco;
  const Board board = write_board_pdf(arguments.output,
                                      {.kind = arguments.kind,
                                       .columns = arguments.corners.at(0),
                                       .rows = arguments.corners.at(1),
                                       .square_mm = arguments.square_mm,
                                       .marker_mm = arguments.marker_mm,
                                       .dictionary = arguments.dictionary,
                                       .first_id = arguments.first_id,
                                       .legacy_layout = arguments.legacy_layout},
                                      paper_size(arguments.paper));
  if (terminal.json) {
    const nlohmann::ordered_json result{{"file", arguments.output.string()},
                                        {"kind", name_of(arguments.kind)},
                                        {"corners", {board.columns, board.rows}},
                                        {"square_mm", board.square_mm},
                                        {"marker_mm", marker_side_mm(board)},
                                        {"dictionary", charuco ? board.dictionary : ""}};
    print_json(result);
    return;
  }
  if (!terminal.quiet) {
    print_text(
        "# for scan.toml, once the ruler on the print measures 100 mm\n[board]\n"
        "kind = \"{}\"\n{} = [{}, {}]\n{} = {:g}\n",
        name_of(arguments.kind),
        circles ? "circles" : "corners",
        board.columns,
        board.rows,
        circles ? "spacing_mm" : "square_mm",
        board.square_mm);
    if (charuco)
      print_text(
          "marker_mm = {:g}\ndictionary = \"{}\"\n", marker_side_mm(board), board.dictionary);
    if (charuco && board.first_id != 0) print_text("first_id = {}\n", board.first_id);
    if (charuco && board.legacy_layout) print_text("legacy_layout = true\n");
  }
  terminal.print_written(arguments.output.string());
}

}  // namespace

void add_calibrate_board_verb(CLI::App& calibrate, Terminal& terminal) {
  auto arguments = std::make_shared<BoardArguments>();
  CLI::App* verb =
      calibrate.add_subcommand("board", "write a board to print at true scale, with a ruler");
  verb->footer("Example:\n  frangia calibrate board --paper a4 -o board.pdf");
  verb->add_option("-o,--output", arguments->output, "PDF to write")->required();
  verb->add_option("--kind", arguments->kind, "checkerboard (default), charuco or circles")
      ->transform(named<BoardKind>());
  verb->add_option("--paper", arguments->paper, "a5, a4, a3 or letter")
      ->check(one_of({"a5", "a4", "a3", "letter"}))
      ->capture_default_str();
  verb->add_option("--corners", arguments->corners, "inner corners, or circles, along x and y")
      ->delimiter(',')
      ->expected(2)
      ->check(from_to(3, 100))
      ->capture_default_str();
  verb->add_option(
          "--square", arguments->square_mm, "side of a square; by default, it fills the paper")
      ->transform(length_above_zero());
  verb->add_option(
          "--marker", arguments->marker_mm, "side of a ChArUco marker; by default, 0.7 of a square")
      ->transform(length_above_zero());
  verb->add_option(
          "--dictionary", arguments->dictionary, "of the ChArUco markers, as OpenCV names it")
      ->capture_default_str();
  verb->add_option("--first-id", arguments->first_id, "id of the first ChArUco marker")
      ->check(from_to(0, 249))
      ->capture_default_str();
  verb->add_flag("--legacy-layout",
                 arguments->legacy_layout,
                 "lay out the ChArUco squares as OpenCV before version 4.6");
  verb->callback([arguments, &terminal] { calibrate_board_verb(*arguments, terminal); });
}

}  // namespace frangia
