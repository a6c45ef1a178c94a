#pragma once

namespace frangia {

/// Exit codes of the program. 0 is success; 128 and more is the end by a signal, as in a shell.
enum ExitCode {
  OutOfTolerance = 1,  ///< a check that was asked for failed
  Usage = 2,           ///< the command line is wrong
  BadInput = 3,        ///< a file or value is wrong, or a file cannot be read or written
  DeviceFault = 4,     ///< a device failed, or views were skipped
  NumericFault = 5,    ///< the result cannot be computed or is not trustworthy
  Interrupted = 130    ///< the user stopped the program
};

}  // namespace frangia
