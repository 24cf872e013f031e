"""The commands of `companion campaign`; `companion campaign SWEEP.yaml` is short for `companion campaign fly ...`."""

from pathlib import Path
from typing import Annotated

import typer
from typer.core import TyperGroup

from companion.cli.options import Json


class SweepOrCommand(TyperGroup):
    """A group whose commands may be left out: whatever else comes first is a sweep to be flown."""

    def parse_args(self, ctx: "typer.Context", args: list[str]) -> list[str]:  # type: ignore[override]
        if args and args[0] not in {*self.commands, "--help"}:
            args = [FLY, *args]
        return super().parse_args(ctx, args)


FLY = "fly"
campaign_app = typer.Typer(
    cls=SweepOrCommand,
    help="Fly sweeps: many flights, one row each. `campaign SWEEP.yaml` is `campaign fly SWEEP.yaml`.",
    no_args_is_help=True,
)
CampaignFolder = Annotated[Path, typer.Argument(metavar="DIR", help="A campaign's folder.")]


@campaign_app.command(FLY)
def fly(
    sweep: Annotated[Path, typer.Argument(metavar="SWEEP", help="What is swept (YAML): docs/campaigns.md.")],
    jobs: Annotated[int, typer.Option("-j", "--jobs", help="Processes.", min=1, max=256)] = 2,
    out: Annotated[
        Path | None, typer.Option("--out", metavar="DIR", help="Folder of the campaign (default: SWEEP-campaign).")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Go on with what is in the folder.")] = False,
    shard: Annotated[
        str | None, typer.Option("--shard", metavar="K/N", help="Fly only the K-th of N parts, such as 3/50.")
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option("--scheduler", metavar="URL", help="Fly on a Dask scheduler's workers: tcp://HOST:PORT."),
    ] = None,
    json: Json = False,
) -> None:
    """Fly every run of a sweep that is not done yet; what is done is never lost, whatever ends this."""
    from companion.cli.campaign import fly_sweep

    raise typer.Exit(fly_sweep(sweep, out, jobs, resume, shard, scheduler, json))


@campaign_app.command("show")
def show(
    folder: CampaignFolder,
    by: Annotated[
        list[str] | None, typer.Option("--by", metavar="COLUMN", help="Group by this (default: by what varies).")
    ] = None,
    png: Annotated[Path | None, typer.Option("--png", metavar="DIR", help="Pictures, into this folder.")] = None,
    json: Json = False,
) -> None:
    """What a campaign has found so far: flights in groups, failures by kind, pictures."""
    from companion.cli.campaign_show import show_campaign

    raise typer.Exit(show_campaign(folder, by or [], png, json))


@campaign_app.command("rerun")
def rerun(
    folder: CampaignFolder,
    run: Annotated[str, typer.Argument(metavar="RUN-ID", help="Of a run that is done; its beginning is enough.")],
    record: Annotated[Path | None, typer.Option("--record", metavar="FILE", help="Keep the recording here.")] = None,
    json: Json = False,
) -> None:
    """Fly the very same flight again, and hold it against what is stored (exit 3: they differ)."""
    from companion.cli.campaign import rerun_run

    raise typer.Exit(rerun_run(folder, run, record, json))
