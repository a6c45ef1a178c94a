#pragma once

#include "shared_server.h"

namespace frangia {

/// Reads requests from a connection and answers them until it ends.
void serve_http(tcp::socket socket, const SharedPtr& shared);

}  // namespace frangia
