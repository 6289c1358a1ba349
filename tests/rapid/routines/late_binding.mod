! RAPID Kernel, Late binding: the name of a procedure is a string.
MODULE late_binding
  VAR string name:="job";

  PROC main()
    %"job1"%;
    %name+NumToStr(2,0)% "of two";
    %"JOB3"% 3\loud;
    %":job1"%;
    %"late_binding:job1"%;
    CallByVar "job",1;
    %"TPWrite"% "installed";              ! -> installed
  ENDPROC

  PROC job1()
    TPWrite "first";
    ! -> first
    ! -> first
    ! -> first
    ! -> first
  ENDPROC

  PROC job2(string text)
    TPWrite "second "+text;               ! -> second of two
  ENDPROC

  PROC job3(num n\switch loud)
    IF Present(loud) TPWrite "third "\Num:=n; ! -> third 3
  ENDPROC
ENDMODULE
