"""Two scans into the same folder at once: one is refused by name, and the frames are those of the other."""
import subprocess
import time

from campaign import Answer


def run(campaign):
    answer = Answer("two_sessions", "two `scan` commands into one folder at once", campaign.count(2, 40))
    seconds = campaign.whole()[1]
    for i in range(answer.tried):
        scan = campaign.fresh("shared")
        processes = []
        for delay in (0.0, campaign.random.uniform(0.0, 0.5 * seconds)):
            time.sleep(delay)
            processes.append(subprocess.Popen(campaign.scan_command(scan), stderr=subprocess.PIPE, text=True))
        errors = [process.communicate(timeout=60)[1] for process in processes]
        refused = [error for process, error in zip(processes, errors) if process.returncode != 0]
        if len(refused) != 1:
            answer.failures.append(f"run {i + 1}: {len(refused)} of two scans were refused")
        elif not any(str(process.pid) in refused[0] for process in processes):
            answer.failures.append(f"run {i + 1}: the refusal names no process: {refused[0].strip()}")
        campaign.finish(scan, answer, f"run {i + 1}")
    return answer
