! RAPID Functions, GetNextCyclicBool: which persistents are kept, and how to end that.
MODULE cyclic_bools_told
  PERS bool one:=FALSE;
  PERS bool two:=FALSE;
  PERS bool source:=FALSE;

  PROC main()
    VAR num list;
    VAR string name;
    source:=FALSE;
    SetupCyclicBool one,source;
    SetupCyclicBool two,NOT source;
    TPWrite ValToStr(one)+ValToStr(two);    ! -> FALSETRUE
    TPWrite ValToStr(GetNumberOfCyclicBool()); ! -> 2
    WHILE GetNextCyclicBool(list,name) DO
      TPWrite name;                         ! -> one ! -> two
    ENDWHILE
    RemoveCyclicBool one;
    TPWrite ValToStr(IsCyclicBool(one))+ValToStr(IsCyclicBool("two")); ! -> FALSETRUE
    source:=TRUE;
    WaitTime 0.1;
    TPWrite ValToStr(one)+ValToStr(two);    ! -> FALSEFALSE
    RemoveAllCyclicBool;
    TPWrite ValToStr(GetNumberOfCyclicBool()); ! -> 0
  ENDPROC
ENDMODULE
