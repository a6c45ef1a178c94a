#pragma once

namespace frangia {

/// How strongly a written file or folder is protected against a power failure.
enum class Durability {
  Buffered,  ///< the operating system chooses when to write to the disk
  Synced     ///< the content and its folder entry are on the disk when the call returns; takes tens
             ///< of milliseconds
};

}  // namespace frangia
