// SPDX-License-Identifier: MIT
// Serialisation of the messages of remote pricing.
#pragma once

#include <string>
#include <string_view>

#include "lagrangian/pricer.h"

namespace grove::detail {

std::string bytes_of(const PricingRequest& request);
std::string bytes_of(const PricingReply& reply);
// Inverses of bytes_of(). They throw std::invalid_argument if `bytes` is not a valid message.
PricingRequest pricing_request_of(std::string_view bytes);
PricingReply pricing_reply_of(std::string_view bytes);

}  // namespace grove::detail
