"""SIGKILL at random moments of a scan; the same command again until the scan is complete."""
import subprocess

from campaign import Answer, count_lost


def run(campaign):
    answer = Answer("kills", "`scan` killed (SIGKILL) at random moments, then finished", campaign.count(4, 500))
    seconds = campaign.whole()[1]
    killed = 0
    while killed < answer.tried:
        scan = campaign.fresh("killed")
        for _ in range(min(3, answer.tried - killed)):
            process = subprocess.Popen(campaign.scan_command(scan), stderr=subprocess.DEVNULL)
            try:
                process.wait(timeout=campaign.random.uniform(0.0, seconds))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            killed += 1
            if count_lost(scan):
                answer.failures.append(f"kill {killed}: an acknowledged frame is lost")
        campaign.finish(scan, answer, f"kill {killed}")
    return answer
