# SPDX-License-Identifier: MIT
"""What the drivers of the benchmarks share: how values are summed up, and on what machine they were measured."""
import datetime
import os
import statistics


def spread(values):
    """The median, and the interval that holds what it estimates in 95 of 100 cases, by the ranks of a binomial; the
    extremes where there are fewer than six values."""
    ordered = sorted(values)
    n = len(ordered)
    below, rank, ways = 0.0, 0, 1
    for k in range((n + 1) // 2):
        below += ways / 2.0**n
        if below > 0.025:
            break
        rank = k
        ways = ways * (n - k) // (k + 1)
    return {"median": statistics.median(ordered), "low": ordered[rank], "high": ordered[n - 1 - rank]}


def first_value(path, key, separator):
    try:
        with open(path, encoding="utf-8") as file:
            return next((l.split(separator, 1)[1].strip().strip('"') for l in file if l.startswith(key)), "")
    except OSError:
        return ""


def describe_machine():
    return {"processor": first_value("/proc/cpuinfo", "model name", ":"), "cores": os.cpu_count(),
            "system": first_value("/etc/os-release", "PRETTY_NAME", "="), "load_before": round(os.getloadavg()[0], 2),
            "date": datetime.date.today().isoformat()}
