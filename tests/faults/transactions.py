"""Random commands of the app while writes fail, jobs are stopped, the power is cut and the server ends, judged by the test
program of the service. The long run goes on where it was interrupted."""
import concurrent.futures
import json
import os
import subprocess

from campaign import ROOT, Answer

BATCH = 50
PROGRESS = ROOT / "out" / "faults" / "transactions.json"


def run(campaign):
    answer = Answer(
        "transactions",
        "random commands of the app with failing writes, stops, power cuts and ends of the server",
        campaign.count(8, 5000),
    )
    program = campaign.program.parent.parent / "tests" / "test_service"
    if not program.exists():
        raise SystemExit(f"faults: transactions needs {program}; build it")
    state = program.stat()
    built = [state.st_size, state.st_mtime_ns]
    done = set()
    if campaign.is_long and PROGRESS.exists():
        before = json.loads(PROGRESS.read_text())
        done = set(before["done"]) if before["built"] == built else set()

    def batch(first):
        count = min(BATCH, answer.tried + 1 - first)
        environment = {**os.environ, "FRANGIA_FIRST_SEED": str(first), "FRANGIA_SEQUENCES": str(count)}
        result = subprocess.run(
            [program, "--gtest_brief=1", "--gtest_filter=SurfaceTransactions.*"],
            env=environment,
            capture_output=True,
            text=True,
            errors="replace",
        )
        return first, result

    wanted = [first for first in range(1, answer.tried + 1, BATCH) if first not in done]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() if campaign.is_long else 1) as pool:
        for first, result in pool.map(batch, wanted):
            if result.returncode != 0:
                answer.failures.append(f"sequences from {first}: {result.stdout[-3000:]}{result.stderr[-1000:]}")
                continue
            done.add(first)
            if campaign.is_long:
                PROGRESS.parent.mkdir(parents=True, exist_ok=True)
                temporary = PROGRESS.with_suffix(".tmp")
                temporary.write_text(json.dumps({"built": built, "done": sorted(done)}))
                os.replace(temporary, PROGRESS)
    if campaign.is_long and not answer.failures:
        PROGRESS.unlink(missing_ok=True)
    answer.measured = "8 commands each"
    return answer
