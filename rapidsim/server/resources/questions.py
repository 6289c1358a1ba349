"""Questions of programs to the operator, which clients may answer as the FlexPendant does."""

from __future__ import annotations

from rapidsim.controller.cell.pendant import Question
from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import BAD_PARAMETER, NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext, required_value


def active(context: RequestContext, request: Request) -> Answer:
    """The questions that wait for an answer.

    Raises:
        RefusedRequest: If no question waits.
    """
    del request
    found = context.live.pendant.questions.values()
    if not found:
        raise refused(NOT_FOUND, "no program asks anything")
    return Answer(tuple(map(question_item, found)))


def answer(context: RequestContext, request: Request, parameter: str) -> Answer:
    """Answer the question of the task whose stack is at the start of an address.

    Raises:
        RefusedRequest: If the task has no question, or this is not a valid answer.
    """
    parts = parameter.lower().split("/")
    text = required_value(request.form, "value")
    for question in context.live.pendant.questions.values():
        if question.task.lower() in parts:
            try:
                context.live.answer(question.task, text.strip('"'))
            except ValueError as error:
                raise refused(BAD_PARAMETER, str(error)) from None
            return DONE
    raise refused(NOT_FOUND, f"no program asks anything at {parameter}")


def question_item(question: Question) -> Item:
    """Return a question as clients see it; its keys are answered by text or by number, from 1."""
    name = question.instruction
    fields = {
        # Controllers name UIMsgBox IMsgBox.
        "instr": name.removeprefix("U") if name.startswith("UI") else name,
        "event": "SEND",
        "stack": f"RAPID/{question.task}",
        "execlv": "NORMAL",
        "msg": question.prompt,
        "keys": " / ".join(filter(None, question.choices)),
    }
    return Item("rap-uiactive-li", "active", fields, href="rw/rapid/uiinstr/active")
