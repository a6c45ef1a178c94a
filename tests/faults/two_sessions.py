"""Two scans into the same folder at once: one is refused by name, and the frames are those of the other."""
import signal
import subprocess
import time

from campaign import Answer, acknowledged_frames


def run(campaign):
    answer = Answer("two_sessions", "two `scan` commands into one folder at once", campaign.count(2, 40))
    for i in range(answer.tried):
        for _ in range(10):  # until both ran at the same time: on a busy machine one may end before the other begins
            scan = campaign.fresh("shared")
            processes, errors = start_both(campaign, scan, together=i % 2 == 0)
            refused = [error for process, error in zip(processes, errors) if process.returncode != 0]
            if refused:
                break
        if len(refused) != 1:
            answer.failures.append(f"run {i + 1}: {len(refused)} of two scans were refused")
        elif not any(str(process.pid) in refused[0] for process in processes):
            answer.failures.append(f"run {i + 1}: the refusal names no process: {refused[0].strip()}")
        campaign.finish(scan, answer, f"run {i + 1}")
    return answer


def start_both(campaign, scan, together):
    """Both processes, ended, and what each wrote: started together, or the second while the first, halted, owns the folder.

    The first is halted when it owns the folder, or when it has captured some of its frames.
    """
    first = start(campaign, scan)
    if not together:
        wanted = campaign.random.randint(0, 3)
        while first.poll() is None and (
            not (scan / ".frangia-lock").exists() or len(acknowledged_frames(scan)) < wanted
        ):
            time.sleep(0.001)
        first.send_signal(signal.SIGSTOP)
    second = start(campaign, scan)
    processes = [first, second]
    if not together:
        processes.reverse()  # the halted one goes on when the other has ended
    errors = []
    for process in processes:
        process.send_signal(signal.SIGCONT)
        errors.append(process.communicate(timeout=120)[1])
    return processes, errors


def start(campaign, scan):
    return subprocess.Popen(campaign.scan_command(scan), stderr=subprocess.PIPE, text=True)
