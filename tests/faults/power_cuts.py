"""The writes of a scan are recorded once and replayed up to random moments, as two kinds of disks keep them."""
import shutil

import write_log
from campaign import Answer, acknowledged_frames, count_lost


def run(campaign):
    answer = Answer(
        "power_cuts",
        "power cut at random writes of `scan` (ordered and reordered disks), then finished",
        campaign.count(4, 300),
    )
    if not shutil.which("strace"):
        raise SystemExit("faults: power_cuts needs strace; install it")
    scan = campaign.fresh("recorded")
    log = scan.parent / "writes"
    if write_log.record(campaign.scan_command(scan), log) != 0:
        answer.failures.append("the recorded scan failed")
        return answer
    operations = list(write_log.operations(log, scan))
    if len(operations) < 100:
        answer.failures.append(f"only {len(operations)} operations were recorded")
    answer.measured = f"{len(operations)} operations recorded"
    for i in range(answer.tried):
        cut = campaign.random.randint(1, len(operations))
        model = ("ordered", "reordered")[i % 2]
        disk = write_log.Disk()
        for operation in operations[:cut]:
            disk.apply(operation)
        left = campaign.fresh("cut")
        disk.write_to(left, campaign.random if model == "reordered" else None)
        what = f"cut after operation {cut} ({' '.join(map(str, operations[cut - 1][:2]))}), {model}"
        # Acknowledged: the line of the manifest is synced.
        manifest = disk.names.get(b"capture/manifest.txt")
        certain = campaign.fresh("certain")
        if manifest is not None:
            (certain / "capture").mkdir(parents=True)
            (certain / "capture" / "manifest.txt").write_bytes(disk.synced[manifest])
        if count_lost(left, acknowledged_frames(certain)):
            answer.failures.append(f"{what}: an acknowledged frame is lost")
        campaign.finish(left, answer, what)
        for folder in (left.parent, certain.parent):
            shutil.rmtree(folder)
    return answer
