! RAPID Functions, UIListView and UIMessageBox: what they answer when the time is over.
MODULE choices_by_default
  CONST listitem parts{3}:=[["","bolt"],["","nut"],["","washer"]];
  CONST string keys{2}:=["Go","No"];
  VAR errnum why;
  VAR btnres pressed:=9;
  VAR num chosen;

  PROC main()
    chosen:=UIListView(\Result:=pressed\Header:="Which?",parts\BtnArray:=keys\Icon:=iconInfo\DefaultIndex:=2\MaxTime:=1\BreakFlag:=why);
    ! -> Which?
    TPWrite ValToStr(chosen)+" "+ValToStr(pressed=resUnkwn)+" "+ValToStr(why=ERR_TP_MAXTIME);  ! -> 2 TRUE TRUE
    chosen:=UIMessageBox(\Header:="Ready"\Message:="Go on?"\Buttons:=btnYesNo\DefaultBtn:=resNo\MaxTime:=1\BreakFlag:=why);
    ! -> Ready / Go on?
    TPWrite ValToStr(chosen=resNo);                      ! -> TRUE
    chosen:=UIMessageBox(\Message:="And now?"\Buttons:=btnYesNo\DefaultBtn:=resYes\MaxTime:=1);
    ! -> And now?
    TPWrite ValToStr(chosen=resNo);                      ! -> TRUE
  ERROR
    TPWrite "late "\Bool:=ERRNO=ERR_TP_MAXTIME;          ! -> late TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
