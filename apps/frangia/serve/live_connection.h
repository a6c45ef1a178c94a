#pragma once

#include "shared_server.h"

namespace frangia {

/// Turns a connection into a WebSocket that lives until its client leaves.
void serve_live(beast::tcp_stream stream,
                const http::request<http::string_body>& request,
                const SharedPtr& shared);

}  // namespace frangia
