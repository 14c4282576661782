// SPDX-License-Identifier: MIT
//
// What is asked of a host's depth-stencil and conventions before volumes are counted in it, whoever
// counts: the one place where guests refuse.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadow_pass/guest_pass.hpp>
#include <gnomon/shadows/host_view.hpp>

namespace gnomon::shadow_pass::internal {

/// `who`: "the guest pass", for the sentences. Fails as GuestPass::create() says.
[[nodiscard]] Status check_guest(const gpu::Device& device, const GuestPassDesc& desc,
                                 const std::string& who);

/// Of the ShadowPass that counts in the host's stencil, beside these colours.
[[nodiscard]] ShadowPassDesc shadow_pass_of(const GuestPassDesc& desc,
                                            std::vector<gpu::Format> color_formats);

/// That a frame's view is by the conventions that its pass was made for.
[[nodiscard]] Status check_view(const GuestPassDesc& desc, const shadows::HostView& view,
                                const std::string& who);

/// That lights `first` to `first + count - 1` are of the list that was prepared last: `lights`,
/// nothing where prepare() was not called or failed. `done`: "be counted".
[[nodiscard]] Status check_lights(std::optional<std::size_t> lights, std::size_t first,
                                  std::size_t count, const std::string& who,
                                  const std::string& done);

/// "320 x 240 pixels", "4 samples".
[[nodiscard]] std::string size_words(TargetSize size);
[[nodiscard]] std::string sample_words(std::uint32_t samples);

}  // namespace gnomon::shadow_pass::internal
