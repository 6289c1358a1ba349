MODULE Questions
  ! Twenty small questions to a controller, real or virtual. Main asks them all, in two minutes, and
  ! writes the answers to HOME:/rapidsim_answers.txt. `rapidsim protocol FILE` reads that file.
  !
  ! The last three move the arm: up to 330 mm from [0,0,0,0,30,0], without a load, with tool0.
  ! The routines stop_1 to stop_5 each stop the program: start them by hand (PP to Routine) and write
  ! down the number of the event.

  VAR iodev answers;
  VAR iodev other;
  VAR num tries;
  VAR num zero:=0;
  VAR clock watch;
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    Open "HOME:/rapidsim_answers.txt",answers\Write;
    Write answers,"questions;1";
    Write answers,"robotware;"+GetSysInfo(\SWVersion);
    Write answers,"robot;"+GetSysInfo(\RobotType);
    quotient;
    remainder;
    binary_file;
    retries;
    error_number_after_clause;
    large_number;
    Write answers,"7;"+ValToStr(0.1+0.2);
    Write answers,"8;"+ValToStr(Round(2.5))+" "+ValToStr(Round(-2.5))+" "+ValToStr(Round(3.5));
    long_text;
    odd_index;
    missing_dimension;
    no_number;
    configuration 13,1,0;
    configuration 14,2,0;
    configuration 15,0,1;
    loops;
    no_wait;
    tiny_moves;
    picking;
    swing;
    Close answers;
    TPWrite "Done: HOME:/rapidsim_answers.txt";
  ENDPROC

  PROC quotient()
    VAR num n:=7.5;
    n:=n DIV 2;
    Write answers,"1;"+ValToStr(n);
  ERROR
    Write answers,"1;error "+ValToStr(ERRNO);
    RETURN;
  ENDPROC

  PROC remainder()
    VAR num n:=7.5;
    n:=n MOD 2;
    Write answers,"2;"+ValToStr(n);
  ERROR
    Write answers,"2;error "+ValToStr(ERRNO);
    RETURN;
  ENDPROC

  ! Is a file that is opened with \Bin alone begun anew, or appended to?
  PROC binary_file()
    VAR num bytes{2}:=[65,66];
    Open "HOME:/rapidsim_bytes.bin",other\Write\Bin;
    WriteBin other,bytes,2;
    Close other;
    Open "HOME:/rapidsim_bytes.bin",other\Bin;
    WriteBin other,bytes,2;
    Close other;
    Write answers,"3;"+ValToStr(FileSize("HOME:/rapidsim_bytes.bin"));
    RemoveFile "HOME:/rapidsim_bytes.bin";
  ERROR
    Write answers,"3;error "+ValToStr(ERRNO);
    RETURN;
  ENDPROC

  ! How often may RETRY answer an error before the next clause is asked?
  PROC retries()
    tries:=0;
    fails_always;
    Write answers,"4;no error";
  ERROR
    Write answers,"4;"+ValToStr(tries);
    RETURN;
  ENDPROC

  PROC fails_always()
    zero:=0;
    zero:=1/zero;
  ERROR
    tries:=tries+1;
    IF tries>50 RETURN;
    RETRY;
  ENDPROC

  ! What is ERRNO in a clause after it has called a routine with a clause of its own?
  PROC error_number_after_clause()
    zero:=0;
    zero:=1/zero;
  ERROR
    odd_text;
    Write answers,"5;"+ValToStr(ERRNO=ERR_DIVZERO)+" "+ValToStr(ERRNO);
    RETURN;
  ENDPROC

  PROC odd_text()
    VAR string text;
    text:=StrPart("abc",9,1);
  ERROR
    RETURN;
  ENDPROC

  PROC large_number()
    VAR num n:=16777216;
    n:=n+1;
    Write answers,"6;"+ValToStr(n=16777216)+" "+ValToStr(n);
  ENDPROC

  PROC long_text()
    VAR string text:="0123456789012345678901234567890123456789";
    text:=text+text+"x";
    Write answers,"9;"+ValToStr(StrLen(text));
  ERROR
    Write answers,"9;error "+ValToStr(ERRNO);
    RETURN;
  ENDPROC

  PROC odd_index()
    VAR num list{3}:=[1,2,3];
    VAR num index:=1.5;
    Write answers,"10;"+ValToStr(list{index});
  ERROR
    Write answers,"10;error "+ValToStr(ERRNO);
    RETURN;
  ENDPROC

  PROC missing_dimension()
    VAR num list{3,2};
    VAR num dimension:=3;
    Write answers,"11;"+ValToStr(Dim(list,dimension));
  ERROR
    Write answers,"11;error "+ValToStr(ERRNO);
    RETURN;
  ENDPROC

  PROC no_number()
    VAR num n:=5;
    VAR bool ok;
    ok:=StrToVal("twelve",n);
    Write answers,"12;"+ValToStr(ok)+" "+ValToStr(n);
  ERROR
    Write answers,"12;error "+ValToStr(ERRNO);
    RETURN;
  ENDPROC

  ! Is a target reached whose stored configuration is off by quarters of axis 1, or by a branch?
  PROC configuration(num question,num quarters,num branch)
    VAR robtarget target;
    VAR jointtarget joints;
    target:=CalcRobT(home,tool0);
    target.robconf.cf1:=target.robconf.cf1+quarters;
    target.robconf.cfx:=target.robconf.cfx+branch;
    joints:=CalcJointT(target,tool0);
    Write answers,ValToStr(question)+";reached "+ValToStr(joints.robax.rax_1);
  ERROR
    Write answers,ValToStr(question)+";error "+ValToStr(ERRNO);
    RETURN;
  ENDPROC

  PROC loops()
    VAR num count:=0;
    ClkReset watch;
    ClkStart watch;
    FOR i FROM 1 TO 10000 DO
      count:=count+1;
    ENDFOR
    ClkStop watch;
    Write answers,"16;"+NumToStr(ClkRead(watch),3);
  ENDPROC

  PROC no_wait()
    ClkReset watch;
    ClkStart watch;
    FOR i FROM 1 TO 100 DO
      WaitTime 0;
    ENDFOR
    ClkStop watch;
    Write answers,"17;"+NumToStr(ClkRead(watch),3);
  ENDPROC

  ! What does a stop point cost behind a move of a tenth of a millimetre?
  PROC tiny_moves()
    VAR robtarget start;
    MoveAbsJ home,v200,fine,tool0;
    start:=CRobT();
    ClkReset watch;
    ClkStart watch;
    FOR i FROM 1 TO 20 DO
      MoveL Offs(start,0,0,0.1*i),v200,fine,tool0;
    ENDFOR
    ClkStop watch;
    Write answers,"18;"+NumToStr(ClkRead(watch),3);
  ENDPROC

  PROC picking()
    VAR robtarget start;
    MoveAbsJ home,v200,fine,tool0;
    start:=CRobT();
    start:=Offs(start,0,-150,0);
    MoveL start,v200,fine,tool0;
    ClkReset watch;
    ClkStart watch;
    FOR i FROM 1 TO 3 DO
      MoveL Offs(start,0,0,25),vmax,z10,tool0;
      MoveL Offs(start,0,300,25),vmax,z10,tool0;
      MoveL Offs(start,0,300,0),vmax,fine,tool0;
      MoveL Offs(start,0,300,25),vmax,z10,tool0;
      MoveL Offs(start,0,0,25),vmax,z10,tool0;
      MoveL start,vmax,fine,tool0;
    ENDFOR
    ClkStop watch;
    Write answers,"19;"+NumToStr(ClkRead(watch),3);
    MoveAbsJ home,v200,fine,tool0;
  ENDPROC

  PROC swing()
    VAR jointtarget there;
    there:=home;
    there.robax.rax_1:=60;
    MoveAbsJ home,v200,fine,tool0;
    ClkReset watch;
    ClkStart watch;
    FOR i FROM 1 TO 3 DO
      MoveAbsJ there,vmax,fine,tool0;
      MoveAbsJ home,vmax,fine,tool0;
    ENDFOR
    ClkStop watch;
    Write answers,"20;"+NumToStr(ClkRead(watch),3);
  ENDPROC

  ! Each of these stops the program. Which event does the log show, and does the clause run?

  PROC stop_1()
    MoveAbsJ home,v200,fine,tool0;
    MoveL Offs(CRobT(),9000,0,0),v200,fine,tool0;
  ERROR
    TPWrite "the clause runs";
    TRYNEXT;
  ENDPROC

  PROC stop_2()
    VAR robtarget target;
    MoveAbsJ home,v200,fine,tool0;
    target:=CRobT();
    target.robconf.cf1:=target.robconf.cf1+2;
    MoveJ target,v200,fine,tool0;
    TPWrite "two quarters off is no error";
  ERROR
    TPWrite "the clause runs";
    TRYNEXT;
  ENDPROC

  PROC stop_3()
    VAR robtarget target;
    MoveAbsJ home,v200,fine,tool0;
    target:=CRobT();
    target.rot:=[0,0,0,0];
    MoveJ target,v200,fine,tool0;
  ERROR
    TPWrite "the clause runs";
    TRYNEXT;
  ENDPROC

  PROC stop_4()
    zero:=0;
    zero:=1/zero;
  ENDPROC

  PROC stop_5()
    %"no_such_routine"%;
  ENDPROC
ENDMODULE
