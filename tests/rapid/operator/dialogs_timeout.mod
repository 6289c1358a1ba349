! RAPID Functions, UIMessageBox: after a time-out a dialog gives what it had before, or nothing.
MODULE dialogs_timeout
  CONST listitem parts{2}:=[["","one"],["","two"]];

  PROC main()
    VAR errnum broke;
    VAR btnres pressed;
    TPWrite ValToStr(UIMessageBox(\Message:="ok?"\Buttons:=btnYesNo\MaxTime:=1\BreakFlag:=broke)); ! -> ok? ! -> 0
    TPWrite ValToStr(UIMessageBox(\Message:="or?"\Buttons:=btnYesNo\DefaultBtn:=resNo\MaxTime:=1\BreakFlag:=broke)=resNo); ! -> or? ! -> TRUE
    TPWrite ValToStr(UINumEntry(\Message:="n?"\InitValue:=5\MaxTime:=1\BreakFlag:=broke)); ! -> n? ! -> 5
    TPWrite ValToStr(UINumTune(\Message:="t?",3,0.1\MaxTime:=1\BreakFlag:=broke)); ! -> t? ! -> 3
    TPWrite UIAlphaEntry(\Message:="s?"\InitString:="D2"\MaxTime:=1\BreakFlag:=broke); ! -> s? ! -> D2
    TPWrite ValToStr(UIListView(\Header:="l?",parts\DefaultIndex:=2\MaxTime:=1\BreakFlag:=broke)); ! -> l? ! -> 2
    TPWrite ValToStr(broke=ERR_TP_MAXTIME); ! -> TRUE
    UIMsgBox "box"\Buttons:=btnOKCancel\Result:=pressed\MaxTime:=1\BreakFlag:=broke; ! -> box
    TPWrite ValToStr(pressed=resUnkwn);     ! -> TRUE
  ENDPROC
ENDMODULE
