// SPDX-License-Identifier: MIT
#include "inspect_command.hpp"

#include "files.hpp"
#include "inspection.hpp"

namespace gnomon::cli {

Result<std::string> inspect(const InspectOptions& options) {
    if (!options.obj.empty()) {
        if (const Status writable = check_writable(options.obj); !writable) {
            return forward_error(writable);
        }
    }
    const auto inspection = look_into(options.model);
    if (!inspection) return forward_error(inspection);
    if (!options.obj.empty()) {
        OutputFiles files;
        if (const Status added = files.add(options.obj, as_obj(*inspection)); !added) {
            return forward_error(added);
        }
        if (const Status done = files.commit(); !done) return forward_error(done);
    }
    return options.json ? as_json(*inspection) : as_text(*inspection);
}

}  // namespace gnomon::cli
