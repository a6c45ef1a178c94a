#pragma once

#include "client_stream.h"
#include "shared_server.h"

namespace frangia {

/// Turns a connection into a WebSocket that lives until its client leaves; `place` counts it among
/// the connections.
void serve_live(ClientStream stream,
                const http::request<http::string_body>& request,
                const SharedPtr& shared,
                Claim place);

}  // namespace frangia
