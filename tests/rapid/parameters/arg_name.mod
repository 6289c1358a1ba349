! RAPID Functions, ArgName: the name of the data that a routine was given, through all routines between.
MODULE arg_name
  VAR num speed_1:=5;
  VAR num list{3};
  PERS pos Corner:=[1,2,3];
  VAR string late:="told";

  PROC main()
    VAR num Own:=1;
    told speed_1;
    told Own;
    through speed_1;
    through list{2}\extra:=Own;
    %late% Own;
    told 1+Own;
    TPWrite named(speed_1)+named(Corner.x); ! -> speed_1Corner
    TPWrite                               ! -> on a later line Own
      "on a later line "
      + named(Own);
    TPWrite                               ! -> nn
      named(Own)
      +named(speed_1);
    TPWrite ArgName(speed_1);             ! -> speed_1
    named_err Own+1;
    named_err Own;
  ENDPROC

  PROC through(num n\num extra)
    told n;
    IF Present(extra) told extra;
  ENDPROC

  PROC told(num n)
    TPWrite ArgName(n);
    ! -> speed_1
    ! -> Own
    ! -> speed_1
    ! -> list
    ! -> Own
    ! -> Own
  ERROR
    IF ERRNO=ERR_ARGNAME TPWrite "error"; ! -> error
    RETURN;
  ENDPROC

  FUNC string named(num n)
    RETURN ArgName(n);                    ! warning: R104
  ENDFUNC

  PROC named_err(num n)
    VAR string name;
    VAR errnum number:=0;
    name:=ArgName(n\ErrorNumber:=number);
    TPWrite name+ValToStr(number=ERR_ARGNAME); ! -> TRUE ! -> OwnFALSE
  ENDPROC
ENDMODULE
