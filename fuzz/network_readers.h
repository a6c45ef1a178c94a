#pragma once

#include <string_view>

namespace frangia {

/// What a network sends to the server of the operator's app. Inputs hold `kFuzzKey` where a client
/// sends its key; it is replaced by the key of the server under test, which is as long.
inline constexpr std::string_view kFuzzKey = "KEY-KEY-KEY-KEY-KEY-KEY-KEY-KEY-KEY-KEY-KEY";
inline constexpr std::string_view kFuzzToken = "TOKEN-TOKEN-TOKEN-TOKEN-TOKEN-TOKEN-TOKEN-T";

/// All bytes that a client sends on one connection, from the first request on.
void take_http(std::string_view bytes);
/// All bytes that a client sends after its WebSocket was accepted.
void take_live(std::string_view bytes);
/// One message of a WebSocket.
void take_message(std::string_view bytes);
/// A line with the name of a command, then its arguments.
///
/// @errors   Error when the service refuses the command
void take_command(std::string_view bytes);

}  // namespace frangia
