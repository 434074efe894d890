"""The command line: arguments → pipeline, errors → exit status (DESIGN section 9).

0 done; 1 the input is at fault, in one line on standard error; 2 wrong usage;
130 interrupted. Nothing here computes anything.
"""

from __future__ import annotations

import errno
import io
import os
import sys
from contextlib import suppress
from importlib import import_module

import click

from lipwright.errors import LipwrightError

# Each command lives in a module that is imported when it is used: --help stays quick.
COMMANDS = {
    "say": ("lipwright.cli.speak", "say", "Type text: speech, and the face that speaks it."),
    "animate": ("lipwright.cli.speak", "animate", "Animate a recording."),
    "phones": ("lipwright.cli.speak", "phones", "When each phone of a recording sounds."),
    "set": ("lipwright.cli.sets", "bigram_set", "Look into bigram sets: coverage, show, why."),
    "motion": ("lipwright.cli.motion", "motion", "Recorded motion: build, add, info, bind."),
    "neural": ("lipwright.cli.neural", "neural", "Nets that hear: train, info."),
    "character": ("lipwright.cli.characters", "character", "What a character's rig has."),
    "studio": ("lipwright.cli.studio", "studio", "Edit sets and lines in the browser."),
    "evaluate": ("lipwright.cli.evaluate", "evaluate", "Hold animation against recordings."),
}


class _Commands(click.Group):
    """A group whose commands are imported when asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        module, attribute, _ = COMMANDS[cmd_name]
        command: click.Command = getattr(import_module(module), attribute)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl([(name, about) for name, (_, _, about) in COMMANDS.items()])


def _version(ctx: click.Context, param: click.Parameter, value: bool) -> None:
    if value:
        from lipwright import __version__

        click.echo(f"lipwright {__version__}")
        ctx.exit()


@click.command(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="'lipwright COMMAND --help' says more of one command.",
)
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_version,
    help="Print the version.",
)  # fmt: skip
def cli() -> None:
    """Turn speech, typed or recorded, into facial animation that you can edit."""


def main(arguments: list[str] | None = None) -> int:
    """Run a command and return its exit status."""
    try:
        result = cli.main(arguments, prog_name="lipwright", standalone_mode=False)
        sys.stdout.flush()
    except click.exceptions.Exit as leave:
        return leave.exit_code
    except (click.Abort, KeyboardInterrupt):
        print("lipwright: interrupted; nothing was left half-written", file=sys.stderr)
        return 130
    except click.ClickException as wrong:
        wrong.show()
        return wrong.exit_code
    except LipwrightError as error:
        print(f"lipwright: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        return _stream_failed(error)
    return result if isinstance(result, int) else 0


def _stream_failed(error: OSError) -> int:
    """Answer for standard output that takes no more, or a working folder that is gone."""
    if error.errno in (errno.EPIPE, errno.ENOSPC):
        # Python must not try again when it ends.
        with suppress(OSError, AttributeError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if error.errno == errno.EPIPE:  # whoever read our output has enough
        return 0
    print(f"lipwright: {error.filename or 'standard output'}: {error.strerror}", file=sys.stderr)
    return 1


def run_and_leave() -> None:
    """Run the command line as a program: streams made safe, then :func:`main`."""
    # The matrices here are small: threads would only wait for each other, on a busy
    # machine for longer than the work takes. It must be said before numpy is imported.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:  # closed by whoever started us
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115, PTH123
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    try:
        status = main()
    except SystemExit as leave:  # click leaves by itself when its output is not read
        status = leave.code if isinstance(leave.code, int) else 1
    sys.exit(status)
